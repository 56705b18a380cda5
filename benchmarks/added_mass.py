#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How much the added mass of a cylinder depends on where it is on the grid: a body that moves across cells feels every
change of it as a force.

usage: benchmarks/added_mass.py [PROGRAM] [--across 12]... [--places 16] [--check]

The fluid of prm/oscillating_cylinder.prm starts without vorticity, as the cylinder does with a velocity u: twice its
kinetic energy over u^2 is the added mass. Printed are, over places within a cell along the motion, the mean in proportion
to the mass of the fluid that the cylinder displaces, the difference of the largest and the smallest one, and the largest
change from place to place over the width of a cell, in proportion to the mean. --check: exit code 1 if the difference is
larger than DIFFERENCE says. One rank; half a minute with 16 places.
"""
import argparse
import math
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [ROOT, os.path.join(ROOT, "benchmarks")]
from oscillating_cylinder import DIAMETER, HEIGHT, LENGTH, SCENE  # noqa: E402
from study import runs  # noqa: E402

ACROSS = 0.18  # of a cell, from a plane of the grid to the centre: no symmetry
DIFFERENCE = {6: 0.02, 12: 0.005, 24: 0.001}  # by cells across the cylinder


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--across", action="append", type=int)
    parser.add_argument("--places", type=int, default=16)
    parser.add_argument("--check", action="store_true")
    return parser.parse_args()


def added_mass(program, across, place):
    """With the centre `place` of a cell's width beyond a plane of the grid, by the mass of the displaced fluid."""
    width = DIAMETER / across
    centre = [LENGTH / 2 + place * width, HEIGHT / 2 + ACROSS * width]
    result, columns = runs.single(program, SCENE, {
        "Domain/Cells": f"{round(LENGTH / width)}, {round(HEIGHT / width)}", "Time/Step": "1e-6", "Time/End": "1e-6",
        "Obstacles/cylinder/Centre": f"{centre[0]}, {centre[1]}", "Obstacles/cylinder/Displacement": "t; 0",
        "Obstacles/cylinder/Refinements": "7"})
    if result["failure"]:
        sys.exit(f"added_mass.py: {result['failure']}")
    return 2 * columns["Fluid kinetic energy"][0] / (math.pi * DIAMETER ** 2 / 4)


def main():
    options = arguments()
    if options.check and not set(options.across or DIFFERENCE) <= set(DIFFERENCE):
        sys.exit(f"added_mass.py: --check knows bounds for {', '.join(map(str, DIFFERENCE))} cells across only")
    failed = False
    print("| cells across | added mass | largest less smallest | largest change over a cell |")
    print("|---|---|---|---|")
    for across in options.across or [6, 12, 24]:
        n = options.places
        masses = [added_mass(options.program, across, (place + 0.5) / n) for place in range(n)]
        mean = sum(masses) / n
        difference = (max(masses) - min(masses)) / mean
        change = max(abs(b - a) for a, b in zip(masses, masses[1:] + masses[:1])) * n / mean
        failed = failed or not difference <= DIFFERENCE.get(across, math.inf)
        print(f"| {across} | {mean:.4f} | {100 * difference:.3f} % | {100 * change:.2f} % |", flush=True)
    sys.exit(1 if options.check and failed else 0)


if __name__ == "__main__":
    main()
