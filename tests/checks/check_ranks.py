#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run of many steps is the same on 1, 2, 3 and 4 ranks to 1e-8 if its solvers are exact.

usage: check_ranks.py PROGRAM SCENE.prm [Section/Key=value]...
"""
import os
import sys
import tempfile

import scene_tools

TOLERANCE = 1e-8
STEPS = 10
SETTINGS = (f"Time/Maximum steps={STEPS}", "Output/Parts=statistics",
            "Fluid/Pressure solver/Divergence tolerance=1e-13")


def main():
    program, scene = sys.argv[1:3]
    settings = SETTINGS + tuple(sys.argv[3:])
    arguments = [word for setting in settings for word in ("--set", setting)]
    found = []
    with tempfile.TemporaryDirectory() as folder:
        texts = {}
        for ranks in (1, 2, 3, 4):
            output = os.path.join(folder, str(ranks))
            scene_tools.run(program, [scene, "--output", output] + arguments, ranks)
            texts[ranks] = scene_tools.statistics(output)
        if len(scene_tools.parse(texts[1])[2]) != STEPS + 1:
            sys.exit(f"{STEPS} steps were expected\n{texts[1]}")
        for ranks in (2, 3, 4):
            found += [f"{ranks} ranks, {line}" for line in
                      scene_tools.differences(texts[ranks], texts[1], TOLERANCE, False)]
    if found:
        sys.exit("\n".join(found[:20]))
    print(f"{os.path.basename(scene)}: {STEPS} steps on 1, 2, 3, 4 ranks are the same")


main()
