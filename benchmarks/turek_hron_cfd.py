#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drag and lift of the Turek-Hron benchmark's cylinder with a rigid flag, tests CFD1 to CFD3, against published figures.

usage: benchmarks/turek_hron_cfd.py [PROGRAM] [--case CFD1]... [--cells "192, 110"]... [--step 1/200]... [--check]

Prints a line for every case, grid and step, with core seconds; the scene's own grid leaves planes in the flag's sides.
CFD1 and CFD2 are steady. Of CFD3 means and amplitudes, (largest + smallest)/2 and (largest - smallest)/2, and the
frequency over the last five periods. --check: exit code 1 if a drag or the lift of a steady flow is more than 3 % off. One
rank; a minute for CFD1 and CFD2, ten for CFD3.
"""
import argparse
import csv
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "tests", "checks"), os.path.join(ROOT, "benchmarks")]
import time_integration  # noqa: E402

from turek_hron_swinging_flag import upward_passages  # noqa: E402

REFERENCE = os.path.join(ROOT, "tests", "reference", "turek_hron_cfd.csv")
CASES = ("CFD1", "CFD2", "CFD3")
PERIODS = 5
BOUND = 0.03


def force(columns, axis):
    """Of pressure and friction."""
    return [sum(values) for values in zip(*(columns[f"{kind} force obstacle {axis}"] for kind in ("pressure", "viscous")))]


def steady(columns):
    """{figure: value at the end}"""
    return {"drag_mean": force(columns, "x")[-1], "lift_mean": force(columns, "y")[-1]}


def periodic(columns):
    """{figure: value over the last periods of the lift}"""
    times, lift = columns["Time"], force(columns, "y")
    half = len(times) // 2
    passages = upward_passages(times[half:], lift[half:])
    if len(passages) <= PERIODS:
        sys.exit(f"turek_hron_cfd.py: fewer than {PERIODS} periods in the second half of {times[-1]} s")
    first, last = passages[-1 - PERIODS], passages[-1]
    result = {}
    for name, values in (("drag", force(columns, "x")), ("lift", lift)):
        chosen = [value for time, value in zip(times, values) if first <= time <= last]
        result[f"{name}_mean"] = (max(chosen) + min(chosen)) / 2
        result[f"{name}_amp"] = (max(chosen) - min(chosen)) / 2
    result["lift_freq_Hz"] = PERIODS / (last - first)
    return result


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
    with open(REFERENCE) as file:
        published = {line["case"]: line for line in csv.DictReader(line for line in file if not line.startswith("#"))
                     if line["source"] == "Turek-Hron2006"}
    for case in options.case or CASES:
        for cells in options.cells or ["192, 110"]:
            for step in options.step or [None]:
                run = time_integration.once(options.program, os.path.join(ROOT, "prm", f"turek_hron_{case.lower()}.prm"),
                                            [f"Domain/Cells={cells}"] + ([f"Time/Step={step}"] if step else []))
                if run.complaint:
                    sys.exit(f"turek_hron_cfd.py: {run.complaint}")
                for name, value in (periodic if case == "CFD3" else steady)(run.columns).items():
                    wanted = float(published[case][name])
                    failed = failed or (abs(value / wanted - 1) > BOUND and (case != "CFD3" or name == "drag_mean"))
                    print(f"| {case} | {cells} | {step or 'of the scene'} | {name} | {value:.4g} | {wanted:.4g} | "
                          f"{100 * (value / wanted - 1):+.1f} % | {run.seconds:.0f} |", flush=True)
    sys.exit(1 if options.check and failed else 0)


if __name__ == "__main__":
    main()
