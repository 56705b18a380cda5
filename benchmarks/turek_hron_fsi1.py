#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The flag of the Turek-Hron benchmark FSI1 at rest in a slow flow, against the published figures, over grids and steps.

usage: benchmarks/turek_hron_fsi1.py [PROGRAM] [--grid scene]... [--step 1/10]... [--form flux]... [--end 12] [--check]

Grids: `scene` has cells of 2.5 by 2 mm around cylinder and flag, whose sides lie in planes of the grid; with `between` cells
are as large, but 193 by 109, and the sides lie between planes; `coarse` is that of FSI2, 120 by 61 cells of 6.7 mm. Prints
drag and lift of cylinder and flag, the displacement of the flag's end, differences from Featflow's finest level, and core
seconds. --check: exit code 1 if on the scene's grid drag, lift or rise are off by more than 1, 5 and 6 %. One rank; a minute
for a run with the longest step.
"""
import argparse
import csv
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "tests", "checks"), os.path.join(ROOT, "benchmarks")]
import time_integration  # noqa: E402
from turek_hron_swinging_flag import force  # noqa: E402

SCENE = os.path.join(ROOT, "prm", "turek_hron_fsi1.prm")
REFERENCE = os.path.join(ROOT, "tests", "reference", "turek_hron_fsi1.csv")
EVEN_TO_THE_TIP = "if(x<0.8, 0.325*x, 0.325*x + 0.675*((x-0.8)/0.2)^2*(0.3+0.7*(x-0.8)/0.2))"
GRIDS = {"scene": [], "between": ["Domain/Cells=193, 109"],
         "coarse": ["Domain/Cells=120, 61", f"Domain/Grading x={EVEN_TO_THE_TIP}", "Domain/Grading y=x"]}
BOUNDS = {"drag": 0.01, "lift": 0.05, "uy_m": 0.06}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--grid", action="append", choices=GRIDS)
    parser.add_argument("--step", action="append")
    parser.add_argument("--form", action="append", choices=("along paths", "flux"))
    parser.add_argument("--end", default="12")
    parser.add_argument("--check", action="store_true")
    return parser.parse_args()


def figures(columns):
    """At the end, named as in the reference."""
    return {"drag": force(columns, "x")[-1], "lift": force(columns, "y")[-1],
            "ux_m": columns["A displacement x"][-1], "uy_m": columns["A displacement y"][-1]}


def published():
    with open(REFERENCE) as file:
        return [line for line in csv.DictReader(line for line in file if not line.startswith("#"))
                if line["source"] == "Featflow"][-1]


def main():
    options, wanted, failed = arguments(), published(), False
    print("| grid | step [s] | form | drag [N/m] | lift [N/m] | ux [m] | uy [m] | core seconds |\n" + 8 * "|---" + "|")
    for grid in options.grid or ["scene", "coarse"]:
        for step in options.step or ["1/10", "1/50"]:
            for form in options.form or ["flux"]:
                run = time_integration.once(options.program, SCENE, GRIDS[grid] + [
                    f"Time/Step={step}", f"Time/End={options.end}", f"Effects/convection/Form={form}",
                    "Output/Parts=statistics", "Output/Interval=0"])
                if run.complaint:
                    sys.exit(f"turek_hron_fsi1.py: {run.complaint}")
                row = f"| {grid} | {step} | {form} |"
                for name, value in figures(run.columns).items():
                    error = value / float(wanted[name]) - 1
                    failed = failed or (grid == "scene" and abs(error) > BOUNDS.get(name, 1))
                    row += f" {value:.5g} ({100 * error:+.1f} %) |"
                print(f"{row} {run.seconds:.0f} |", flush=True)
    sys.exit(1 if options.check and failed else 0)


if __name__ == "__main__":
    main()
