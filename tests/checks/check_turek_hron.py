#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The structural benchmarks of Turek and Hron against the published displacements of the flag's tip.

usage: check_turek_hron.py PROGRAM PRM_FOLDER REFERENCE_FOLDER

CSM1 and CSM2 (steady): within 0.5 %. CSM3 (swinging, undamped): mean, amplitude and frequency of the
vertical displacement over two periods within 2 % (means and amplitudes: of the largest excursion).
"""
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(ROOT)
from study import quantities, references, runs  # noqa: E402

STEADY, SWINGING = 0.005, 0.02  # allowed relative errors


def reference(folder):
    """{case: row} of the finest published level."""
    rows = {}
    for row in references.table(os.path.join(folder, "turek_hron_csm.csv")):
        if row["source"] == "Featflow" or row["case"] not in rows:
            rows[row["case"]] = row
    return rows


def tip(program, scene, settings):
    """Times and displacements (x, y) of point A."""
    result, columns = runs.single(program, scene, settings)
    if result["failure"]:
        sys.exit(f"{scene}: {result['failure']}")
    return columns["Time"], columns["A displacement x"], columns["A displacement y"]


def period(times, values):
    """Mean time between upward passages of the mid level, by linear interpolation."""
    passages = quantities.upward_passages(times, values)
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
        _, x, y = tip(program, os.path.join(scenes, f"turek_hron_{case.lower()}.prm"), {})
        for axis, value in (("x", x[-1]), ("y", y[-1])):
            wanted = float(published[case][f"u{axis}_mean_m"])
            good.append(check(f"{case} u{axis} [m]", value, wanted, abs(wanted), STEADY))
    times, x, y = tip(program, os.path.join(scenes, "turek_hron_csm3.prm"), {"Time/End": "2.9"})
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
