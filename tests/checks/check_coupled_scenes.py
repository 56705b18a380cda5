#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of bodies in fluids against the numbers that their comments give.

usage: check_coupled_scenes.py PROGRAM PRM_FOLDER

piston: the period of lambda tan lambda = m_bar / m_water, within 0.5 %. hydrostatic_plate: the deflection of the
plate alone under the water's pressure on meshes refined until it no longer changes
(benchmarks/hydrostatic_plate.py), within 1 %.
"""
import math
import os
import sys
import tempfile

import scene_tools


def columns(program, scene, names, end):
    """Lists of numbers, one for each name."""
    with tempfile.TemporaryDirectory() as folder:
        scene_tools.run(program, [scene, "--output", folder, "--set", f"Time/End={end}",
                                  "--set", "Output/Parts=statistics", "--set", "Output/Interval=0"])
        all_names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    return [[row[all_names.index(name)] for row in rows] for name in names]


def exact_period(ratio, youngs_modulus, density, length):
    """Of a bar of which the ratio of masses bar to fluid is given [s]."""
    lower, upper = 0, math.pi / 2
    for _ in range(60):
        middle = (lower + upper) / 2
        lower, upper = (middle, upper) if middle * math.tan(middle) < ratio else (lower, middle)
    return 2 * math.pi * length / lower / math.sqrt(youngs_modulus / density)


def period(times, values):
    """Mean time between downward passages of zero."""
    passages = [t0 + v0 / (v0 - v1) * (t1 - t0)
                for t0, t1, v0, v1 in zip(times, times[1:], values, values[1:]) if v0 > 0 >= v1]
    return (passages[-1] - passages[0]) / (len(passages) - 1)


def check(what, value, wanted, allowed):
    error = value / wanted - 1
    print(f"{what}: {value:.6g}, expected {wanted:.6g}, error {100 * error:+.2f} %")
    return abs(error) <= allowed


def main():
    program, folder = sys.argv[1:3]
    times, tip = columns(program, os.path.join(folder, "piston.prm"),
                         ("Time", "tip displacement x"), 1.7)
    good = [check("piston, period [s]", period(times, tip), exact_period(0.1, 2e4, 100, 0.5), 0.005)]
    middle, = columns(program, os.path.join(folder, "hydrostatic_plate.prm"),
                      ("middle displacement y",), 0.8)
    good.append(check("hydrostatic_plate, deflection [m]", middle[-1], -0.02083, 0.01))
    if not all(good):
        sys.exit("outside the allowed error")


main()
