#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Steady flows around obstacles in a channel against published forces.

usage: check_channel_flows.py PROGRAM PRM_FOLDER REFERENCE_FOLDER

DFG 2D-1 (cylinder, Reynolds number 20): drag within 1 %, lift and pressure difference within 5 %.
Turek-Hron CFD1 (cylinder with a rigid flag, Reynolds number 20): drag within 1 %, lift within 5 %.
"""
import os
import sys
import tempfile

import scene_tools  # which finds the library of studies, too
from study import references

DRAG, LIFT, PRESSURE = 0.01, 0.05, 0.05  # allowed relative errors


def last_row(program, scene):
    """{column: value} at the end of a run."""
    with tempfile.TemporaryDirectory() as folder:
        scene_tools.run(program, [scene, "--output", folder])
        names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    return dict(zip(names, rows[-1]))


def force(row, obstacle, axis):
    return row[f"pressure force {obstacle} {axis}"] + row[f"viscous force {obstacle} {axis}"]


def check(what, value, wanted, allowed):
    error = value / wanted - 1
    print(f"{what}: {value:.5g}, published {wanted:.5g}, error {100 * error:+.2f} %")
    return abs(error) <= allowed


def rows(folder, name, **wanted):
    return references.table(os.path.join(folder, name), **wanted)


def main():
    program, scenes, folder = sys.argv[1:4]
    published = {line["quantity"]: line["later"] for line in rows(folder, "dfg_2d1_re20.csv")}
    row = last_row(program, os.path.join(scenes, "dfg_2d1.prm"))
    to_coefficient = 2 / (0.2**2 * 0.1)  # 2 / (density * mean speed^2 * diameter)
    good = [
        check("drag coefficient", to_coefficient * force(row, "cylinder", "x"),
              float(published["cd"]), DRAG),
        check("lift coefficient", to_coefficient * force(row, "cylinder", "y"),
              float(published["cl"]), LIFT),
        check("pressure difference [Pa]", row["front pressure"] - row["back pressure"],
              float(published["dp_Pa"]), PRESSURE)]
    published, = rows(folder, "turek_hron_cfd.csv", case="CFD1", source="Turek-Hron2006")
    row = last_row(program, os.path.join(scenes, "turek_hron_cfd1.prm"))
    good += [check(f"CFD1 {name} [N]", force(row, "obstacle", axis),
                   float(published[f"{name}_mean"]), allowed)
             for name, axis, allowed in (("drag", "x", DRAG), ("lift", "y", LIFT))]
    if not all(good):
        sys.exit("outside the allowed error")


main()
