#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run that is stopped and resumed continues as if it had not been: on another number of ranks to
1e-8, on the same number to the last bit.

usage: check_resume.py PROGRAM SCENE.prm [--one-rank] [--same-ranks] [--long] [SECTION/KEY=VALUE ...]

Schemes that run on one rank are resumed on one. Long runs are ten times as long.
"""
import os
import re
import sys
import tempfile

import scene_tools

TOLERANCE = 1e-8
HALF, WHOLE = 3, 6  # steps


def first_difference(broken, straight):
    """Of two files that must have the same bytes."""
    rows = [open(os.path.join(folder, "statistics")).read().splitlines()
            for folder in (broken, straight)]
    if len(rows[0]) != len(rows[1]):
        return [f"{len(rows[0])} rows instead of {len(rows[1])}"]
    return [f"{one}\ninstead of\n{other}" for one, other in zip(*rows) if one != other][:1]


def main():
    program, scene = sys.argv[1:3]
    options = [word for word in sys.argv[3:] if word.startswith("--")]
    settings = [word for word in sys.argv[3:] if word not in options]
    same = "--same-ranks" in options
    first, second = (1, 1) if same or "--one-rank" in options else (2, 3)
    longer = 10 if "--long" in options else 1
    half, whole = HALF * longer, WHOLE * longer

    def call(arguments, ranks, steps, more=()):
        for setting in (*more, f"Time/Maximum steps={steps}"):
            arguments = arguments + ["--set", setting]
        return scene_tools.run(program, arguments, ranks).stdout

    with tempfile.TemporaryDirectory() as folder:
        straight, broken = os.path.join(folder, "straight"), os.path.join(folder, "broken")
        call([scene, "--output", straight], 1, whole, settings)
        call([scene, "--output", broken], first, half, settings)
        begun = re.findall(r"^resumed at step (\d+)", call(["resume", broken], second, whole), re.M)
        if begun != [str(half)]:
            sys.exit(f"the run was resumed at step {begun}, not at {half}")
        if len(scene_tools.parse(scene_tools.statistics(broken))[2]) != whole + 1:
            sys.exit(f"statistics of {whole} steps were expected\n{scene_tools.statistics(broken)}")
        found = (first_difference(broken, straight) if same else
                 scene_tools.differences(scene_tools.statistics(broken),
                                         scene_tools.statistics(straight), TOLERANCE, False))
    if found:
        sys.exit("\n".join(found[:20]))
    print(f"{os.path.basename(scene)}: {half} steps on {first} rank(s), resumed on {second}, "
          f"{'to the bit ' if same else ''}as {whole} steps on 1")


main()
