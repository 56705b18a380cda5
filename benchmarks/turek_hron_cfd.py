#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drag and lift of the Turek-Hron benchmark's cylinder with a rigid flag, tests CFD1 and CFD2, against published figures.

usage: benchmarks/turek_hron_cfd.py [PROGRAM] [--case CFD1]... [--cells "192, 110"]... [--check]

Prints a line for every case and grid, with core seconds; the scene's own grid leaves
planes in the flag's sides. --check: exit code 1 if drag or lift is more than 3 % off. One rank; a minute a case.
"""
import argparse
import csv
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "tests", "checks"), os.path.join(ROOT, "benchmarks")]
import time_integration  # noqa: E402

REFERENCE = os.path.join(ROOT, "tests", "reference", "turek_hron_cfd.csv")
CASES = ("CFD1", "CFD2")
BOUND = 0.03


def force(columns, axis):
    """Of pressure and friction, at the end."""
    return sum(columns[f"{kind} force obstacle {axis}"][-1] for kind in ("pressure", "viscous"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--case", action="append", choices=CASES)
    parser.add_argument("--cells", action="append")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    failed = False
    print("| case | cells | drag [N/m] | difference | lift [N/m] | difference | core seconds |\n|---|---|---|---|---|---|---|")
    with open(REFERENCE) as file:
        published = {line["case"]: line for line in csv.DictReader(line for line in file if not line.startswith("#"))
                     if line["source"] == "Turek-Hron2006"}
    for case in options.case or CASES:
        for cells in options.cells or ["192, 110"]:
            run = time_integration.once(options.program, os.path.join(ROOT, "prm", f"turek_hron_{case.lower()}.prm"),
                                        [f"Domain/Cells={cells}"])
            if run.complaint:
                sys.exit(f"turek_hron_cfd.py: {run.complaint}")
            row = f"| {case} | {cells} |"
            for name, axis in (("drag", "x"), ("lift", "y")):
                value = force(run.columns, axis)
                difference = value / float(published[case][f"{name}_mean"]) - 1
                failed = failed or abs(difference) > BOUND
                row += f" {value:.4g} | {100 * difference:+.1f} % |"
            print(f"{row} {run.seconds:.0f} |", flush=True)
    sys.exit(1 if options.check and failed else 0)


if __name__ == "__main__":
    main()
