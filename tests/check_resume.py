#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run that is stopped and resumed on another number of ranks continues to 1e-8.

usage: check_resume.py PROGRAM SCENE.prm [--one-rank] [--long]

Schemes that run on one rank are resumed on one. Long runs are ten times as long.
"""
import os
import sys
import tempfile

import scene_tools

TOLERANCE = 1e-8
HALF, WHOLE = 3, 6  # steps


def main():
    program, scene = sys.argv[1:3]
    first, second = (1, 1) if "--one-rank" in sys.argv else (2, 3)
    longer = 10 if "--long" in sys.argv else 1
    half, all_steps = HALF * longer, WHOLE * longer
    with tempfile.TemporaryDirectory() as folder:
        straight, broken = os.path.join(folder, "straight"), os.path.join(folder, "broken")
        whole = ["--set", f"Time/Maximum steps={all_steps}"]
        scene_tools.run(program, [scene, "--output", straight] + whole, 1)
        scene_tools.run(program, [scene, "--output", broken, "--set",
                                  f"Time/Maximum steps={half}"], first)
        scene_tools.run(program, ["resume", broken] + whole, second)
        found = scene_tools.differences(scene_tools.statistics(broken),
                                        scene_tools.statistics(straight), TOLERANCE, False)
    if found:
        sys.exit("\n".join(found[:20]))
    print(f"{os.path.basename(scene)}: {half} steps on {first} rank(s), resumed on {second}, as {all_steps} steps on 1")


main()
