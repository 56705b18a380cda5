#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run a scene for two steps and compare its file `statistics` with a recorded one.

usage: check_scene.py PROGRAM SCENE.prm RECORD.output RANKS [--record]

The same record serves every number of ranks: a result must not depend on it. On one rank the head of the scene must say
truly what a run takes (scene_costs.py). Particles are computed in double precision, where the order of sums does not show.
"""
import os
import re
import sys
import tempfile

import scene_costs
import scene_tools

TOLERANCE = 1e-7
WRITTEN = ("log.txt", "original.prm", "parameters.prm", "parameters.json", "timing",
           "effects.json", "summary.json")


def settings(scene):
    """The --set arguments for a scene. Forces on obstacles show how far the projection has been solved."""
    with open(scene) as file:
        text = file.read()
    extra = []
    if re.search(r"^set Scheme *= *particle", text, re.MULTILINE):
        extra = ["--set", "Particles/Precision=double"]
    elif "subsection Obstacles" in text and "subsection Bodies" not in text:
        extra = ["--set", "Fluid/Pressure solver/Divergence tolerance=1e-11"]
    if os.path.basename(scene) == "turek_hron_fsi1.prm":
        # Its flag begins with its sides in planes of the grid, between cells that open by a
        # ten-thousandth of their width: what rounding makes of these shows in the seventh digit.
        extra = ["--set", "Domain/Cells=193, 109"]
    return ["--set", "Time/Maximum steps=2"] + extra


def main():
    program, scene, record, ranks = sys.argv[1:4] + [int(sys.argv[4])]
    with tempfile.TemporaryDirectory() as folder:
        scene_tools.run(program, [scene, "--output", folder] + settings(scene), ranks)
        missing = [name for name in WRITTEN if not os.path.exists(os.path.join(folder, name))]
        if missing:
            sys.exit(f"the run did not write {missing}")
        text = scene_tools.statistics(folder)
        faults = scene_costs.faults(scene, folder) if ranks == 1 and "--record" not in sys.argv else []
    if "--record" in sys.argv:
        with open(record, "w") as file:
            file.write(text)
        return
    with open(record) as file:
        differences = scene_tools.differences(text, file.read(), TOLERANCE, ranks == 1)
    if differences or faults:
        sys.exit("\n".join(differences[:20] + faults))
    print(f"{os.path.basename(scene)} on {ranks} rank(s): as recorded")


if __name__ == "__main__":
    main()
