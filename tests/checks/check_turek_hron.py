#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The structural benchmarks of Turek and Hron against the published displacements of the flag's tip.

usage: check_turek_hron.py PROGRAM PRM_FOLDER REFERENCE_FOLDER

CSM1 and CSM2 (steady): within 0.5 %. CSM3 (swinging, undamped): mean, amplitude and frequency of the
vertical displacement over two periods within 2 % (means and amplitudes: of the largest excursion).
"""
import csv
import os
import sys
import tempfile

import scene_tools

STEADY, SWINGING = 0.005, 0.02  # allowed relative errors


def reference(folder):
    """{case: row} of the finest published level."""
    rows = {}
    with open(os.path.join(folder, "turek_hron_csm.csv")) as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            if row["source"] == "Featflow" or row["case"] not in rows:
                rows[row["case"]] = row
    return rows


def tip(program, scene, settings):
    """Times and displacements (x, y) of point A."""
    with tempfile.TemporaryDirectory() as folder:
        arguments = [scene, "--output", folder, "--set", "Output/Parts=statistics",
                     "--set", "Output/Interval=0"]
        for setting in settings:
            arguments += ["--set", setting]
        scene_tools.run(program, arguments)
        names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    x, y = (names.index(f"A displacement {axis}") for axis in "xy")
    return [row[1] for row in rows], [row[x] for row in rows], [row[y] for row in rows]


def period(times, values):
    """Mean time between upward passages of the mid level, by linear interpolation."""
    middle = (max(values) + min(values)) / 2
    passages = [t0 + (middle - v0) / (v1 - v0) * (t1 - t0)
                for t0, t1, v0, v1 in zip(times, times[1:], values, values[1:])
                if v0 < middle <= v1]
    return (passages[-1] - passages[0]) / (len(passages) - 1)


def check(what, value, wanted, scale, allowed):
    error = (value - wanted) / scale
    print(f"{what}: {value:.6g}, published {wanted:.6g}, error {100 * error:+.2f} %")
    return abs(error) <= allowed


def main():
    program, scenes, folder = sys.argv[1:4]
    published = reference(folder)
    good = []
    for case in ("CSM1", "CSM2"):
        _, x, y = tip(program, os.path.join(scenes, f"turek_hron_{case.lower()}.prm"), [])
        for axis, value in (("x", x[-1]), ("y", y[-1])):
            wanted = float(published[case][f"u{axis}_mean_m"])
            good.append(check(f"{case} u{axis} [m]", value, wanted, abs(wanted), STEADY))
    times, x, y = tip(program, os.path.join(scenes, "turek_hron_csm3.prm"), ["Time/End=2.9"])
    for axis, values in (("x", x), ("y", y)):
        mean, amplitude = (max(values) + min(values)) / 2, (max(values) - min(values)) / 2
        wanted = [float(published["CSM3"][f"u{axis}_{part}_m"]) for part in ("mean", "amp")]
        good.append(check(f"CSM3 u{axis} mean [m]", mean, wanted[0], wanted[1], SWINGING))
        good.append(check(f"CSM3 u{axis} amplitude [m]", amplitude, wanted[1], wanted[1], SWINGING))
    wanted = float(published["CSM3"]["freq_Hz"])
    good.append(check("CSM3 frequency [Hz]", 1 / period(times, y), wanted, wanted, SWINGING))
    if not all(good):
        sys.exit("outside the allowed error")


main()
