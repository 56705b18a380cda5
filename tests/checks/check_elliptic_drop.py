#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The elliptic drop of particles against its exact semi-axes.

usage: check_elliptic_drop.py PROGRAM SCENE.prm REFERENCE.csv

Two swings: each semi-axis stays within a fiftieth of the radius at the start of the exact one.
"""
import csv
import sys
import tempfile

import scene_tools

ALLOWED = 0.02  # of the radius at the start, 1 m
END = 5.0      # [s]


def exact_axes(file_name):
    """{time: (a, b)}"""
    with open(file_name) as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {round(float(row["t"]), 6): (float(row["a"]), float(row["b"])) for row in rows}


def main():
    program, scene, reference = sys.argv[1:4]
    exact = exact_axes(reference)
    with tempfile.TemporaryDirectory() as folder:
        scene_tools.run(program, [scene, "--output", folder, "--set", f"Time/End={END}",
                                  "--set", "Output/Parts=statistics", "--set", "Output/Interval=0"])
        names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    compared, away = 0, []
    for row in rows:
        time = round(row[names.index("Time")], 6)
        if time in exact:
            compared += 1
            for name, axis in zip("ab", exact[time]):
                away.append(abs(row[names.index(name)] - axis))
    if compared < 10:
        sys.exit(f"only {compared} times are in both files")
    if not all(distance <= ALLOWED for distance in away):  # which a number that is none is not
        sys.exit(f"a semi-axis is {max(away):.3f} m off, allowed are {ALLOWED} m: {away}")
    print(f"semi-axes at {compared} times: at most {max(away):.3f} m off")


main()
