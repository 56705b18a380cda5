#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A frame of particles with very many sub-steps says how far it is.

usage: check_long_frame.py PROGRAM SCENE.prm
"""
import re
import subprocess
import sys
import tempfile

import scene_tools

LINE = re.compile(r"\.\.\. (\d+) sub-steps, ([\d.]+) % of the frame; now ([\d.e+-]+) s each, as long "
                  "as allowed")
PATIENCE = 120  # [s]


def main():
    program, scene = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        command = [program, scene, "--output", folder]
        for setting in ("Time/Step=1", "Output/Interval=0", "Particles/Sub-steps/Largest=2e-7"):
            command += ["--set", setting]
        printed = subprocess.Popen(["timeout", "-s", "KILL", str(PATIENCE)] + command,
                                   env=scene_tools.environment(), stdout=subprocess.PIPE, text=True)
        said, text = [], ""
        for line in printed.stdout:
            text += line
            if found := LINE.search(line):
                said.append((int(found[1]), float(found[2]), float(found[3])))
            if len(said) == 2:
                break
        printed.terminate()
        printed.wait()
    if len(said) < 2:
        sys.exit(f"two lines on the frame were expected\n{text}")
    (first, first_share, length), (second, second_share, _) = said
    if not (0 < first < second and first_share <= second_share < 100 and length <= 2e-7):
        sys.exit(f"the lines make no sense\n{text}")
    print(f"after {second} sub-steps {second_share} % of the frame")


main()
