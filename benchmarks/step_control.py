#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Steps chosen by a tolerance: is it met, and what do they cost beside constant steps with the same error?

usage: benchmarks/step_control.py [PROGRAM] [--case NAME]... [--quick]

Prints a table: the largest error of a displacement over its largest value, over the tolerance; what the program's column
`Error in time` says; steps, redone ones included; and the constant steps that have the same error, between those that
were run. The reference has a step of 1/64 of the longest. --quick takes the two largest tolerances and a reference of
1/16. One rank; about a quarter of an hour.
"""
import argparse
import math
import os
import sys
import tempfile
from dataclasses import dataclass

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "tests", "checks"), os.path.join(ROOT, "benchmarks")]
import accuracy  # noqa: E402
import time_integration  # noqa: E402

INTEGRATOR = ["Time/Integrator=trapezoid_bdf2"]
TOLERANCES = (0.1, 0.03, 0.01, 0.003)
LONGEST = 0.1  # s, with a tolerance
STEP = 0.05  # s, of the longest constant steps


@dataclass
class Case:
    """A scene, the column whose error is measured, and what is changed."""
    scene: str
    column: str
    settings: list


CASES = {
    "csm3": Case("prm/turek_hron_csm3.prm", "A displacement y", ["Bodies/flag/Cells=20, 2", "Time/End=2"]),
    "cantilever": Case("prm/cantilever.prm", "tip displacement y", ["Bodies/beam/Cells=10, 1, 2"]),
    "piston": Case("prm/piston.prm", "tip displacement x", []),
    "plate": Case("prm/hydrostatic_plate.prm", "middle displacement y", ["Time/End=1", "Output/Budget=false"]),
    "jet": Case("prm/jet_two_sheets_2d.prm", "first_tip displacement x", ["Time/End=1", "Output/Budget=false"]),
}


def run(program, scene, case, settings):
    result = time_integration.once(program, scene, case.settings + INTEGRATOR + settings +
                                   ["Output/Interval=0.5", "Output/Parts=statistics"])
    if result.complaint:
        sys.exit(f"step_control.py: {' '.join(settings)}: {result.complaint}")
    return result.columns


def series(columns, case):
    return accuracy.Series(columns["Time"], columns[case.column])


def attempts(columns):
    return len(columns["Time"]) - 1 + round(sum(columns["Step cuts"]))


def equal_steps(error, constant):
    """Constant steps with this error: (error, steps) of runs, straight lines between their logarithms."""
    points = sorted((math.log(e), math.log(n)) for e, n in constant if e > 0)
    line = accuracy.Series([e for e, _ in points], [n for _, n in points])
    wanted = min(max(math.log(error), points[0][0]), points[-1][0])
    return math.exp(line.at(wanted))


def measure(program, name, case, finest, tolerances):
    with tempfile.TemporaryDirectory() as folder:
        scene = time_integration.neutral_scene(os.path.join(ROOT, case.scene), folder)
        parts = [2**k for k in range(finest.bit_length())]
        runs = {part: run(program, scene, case, [f"Time/Step={STEP}/{part}"]) for part in parts}
        reference = series(runs.pop(finest), case)
        constant = [(accuracy.errors(series(columns, case), reference)[1], attempts(columns))
                    for columns in runs.values()]
        for tolerance in tolerances:
            columns = run(program, scene, case, [f"Time/Step={LONGEST}", f"Time/Tolerance={tolerance}"])
            error = accuracy.errors(series(columns, case), reference)[1]
            steps, equal = attempts(columns), equal_steps(error, constant)
            print(f"| {name} | {tolerance} | {error:.2g} | {error / tolerance:.2f} | "
                  f"{columns['Error in time'][-1]:.2g} | {steps} | {equal:.0f} | {steps / equal:.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--case", action="append", choices=CASES)
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    print("| case | tolerance | error | over the tolerance | `Error in time` | steps | constant steps | ratio |")
    print("|---|---|---|---|---|---|---|---|")
    for name in options.case or CASES:
        measure(options.program, name, CASES[name], 16 if options.quick else 64,
                TOLERANCES[:2] if options.quick else TOLERANCES)


if __name__ == "__main__":
    main()
