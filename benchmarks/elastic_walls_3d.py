#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic walls in viscous flows in 3D against published figures: a plate in a slow cross flow, and a tube along which a
pulse of pressure runs, over grids and steps.

usage: benchmarks/elastic_walls_3d.py [PROGRAM] [--case plate]... [--cells "60, 24, 24"]... [--step 1/5]... [--check]

Where they are not given, cells and step are the scene's. --check: exit code 1 if a figure is farther from the published
one than 5 % (plate, at its end) or 10 % (tube). One rank; two minutes for the tube, ten for the plate.
"""
import argparse
import csv
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "tests", "checks"), os.path.join(ROOT, "benchmarks")]
import time_integration  # noqa: E402

REFERENCE = os.path.join(ROOT, "tests", "reference")


def published(name, source, quantity):
    with open(os.path.join(REFERENCE, name)) as file:
        return next(float(row["value"]) for row in csv.DictReader(line for line in file if not line.startswith("#"))
                    if source in row.values() and row["quantity"] == quantity)


def plate(columns):
    """{name: (value at the end, published)}: of the half that is computed."""
    force = columns["pressure force plate x"][-1] + columns["viscous force plate x"][-1]
    reference = "elastic_plate_cross_flow.csv", "richter Table6 extrapolated"
    return {"displacement of A, x [m]": (columns["A displacement x"][-1], published(*reference, "ux_A_m")),
            "force, x [N]": (force, published(*reference, "Fx_N"))}


def tube(columns):
    """{name: (value, published)} of the largest widening."""
    radial = columns["A displacement x"]
    largest = max(radial)
    reference = "pressure_pulse_tube.csv", "Tukovic2018 dt2.5e-5"
    return {"largest radial displacement of A [m]": (largest, published(*reference, "ur_max_m")),
            "when [s]": (columns["Time"][radial.index(largest)],
                         published(reference[0], "Tukovic2018", "t_ur_max_s"))}


CASES = {"plate": ("elastic_plate_cross_flow", plate, 0.05), "tube": ("pressure_pulse_tube", tube, 0.1)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--case", action="append", choices=CASES)
    parser.add_argument("--cells", action="append")
    parser.add_argument("--step", action="append")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    failed = False
    print("| case | cells | step [s] | figure | computed | published | difference | core seconds |\n" + 8 * "|---" + "|")
    for case in options.case or CASES:
        scene, figures, bound = CASES[case]
        for cells in options.cells or [None]:
            for step in options.step or [None]:
                given = [f"{key}={value}" for key, value in (("Domain/Cells", cells), ("Time/Step", step)) if value]
                run = time_integration.once(options.program, os.path.join(ROOT, "prm", f"{scene}.prm"), given + [
                    "Output/Parts=statistics", "Output/Interval=0"])
                if run.complaint:
                    sys.exit(f"elastic_walls_3d.py: {run.complaint}")
                for name, (value, wanted) in figures(run.columns).items():
                    difference = value / wanted - 1
                    failed = failed or abs(difference) > bound
                    print(f"| {case} | {cells or 'of the scene'} | {step or 'of the scene'} | {name} | {value:.4g} | "
                          f"{wanted:.4g} | {100 * difference:+.1f} % | {run.seconds:.0f} |", flush=True)
    sys.exit(1 if options.check and failed else 0)


if __name__ == "__main__":
    main()
