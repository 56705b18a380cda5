#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The flags of the Turek-Hron benchmarks FSI2 and FSI3 once they swing periodically, against the published figures.

usage: benchmarks/turek_hron_swinging_flag.py [PROGRAM] [--case FSI2] [--cells "120, 61"] [--step 1/100] [--end 15]
                                              [--results DIR]

Prints means and amplitudes, (largest + smallest)/2 and (largest - smallest)/2, over the last three periods, and the
frequency, with those of Featflow's finest level; core seconds. Where they are not given, cells, step and end are the scene's.
--results: take these results instead of running. One rank; five minutes for FSI2, twenty for FSI3.
"""
import argparse
import csv
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "tests", "checks"), os.path.join(ROOT, "benchmarks")]
import scene_tools  # noqa: E402
import time_integration  # noqa: E402

CASES = ("FSI2", "FSI3")
PERIODS = 3


def columns_of(folder):
    names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    return dict(zip(names, zip(*rows)))


def force(columns, axis):
    """On cylinder and flag, of pressure and friction."""
    parts = [columns[f"{kind} force {thing} {axis}"] for kind in ("pressure", "viscous")
             for thing in ("cylinder", "flag")]
    return [sum(values) for values in zip(*parts)]


def upward_passages(times, values):
    """When the values pass their middle upwards."""
    middle = (max(values) + min(values)) / 2
    return [t0 + (t1 - t0) * (middle - v0) / (v1 - v0)
            for t0, t1, v0, v1 in zip(times, times[1:], values, values[1:]) if v0 < middle <= v1]


def figures(columns):
    """{name: value}, named as in the reference."""
    times, rise = columns["Time"], columns["A displacement y"]
    half = len(times) // 2
    passages = upward_passages(times[half:], rise[half:])
    if len(passages) <= PERIODS:
        sys.exit(f"turek_hron_swinging_flag.py: the flag does not swing {PERIODS} times in the second half of {times[-1]} s")
    first, last = passages[-1 - PERIODS], passages[-1]
    result = {"uy_freq_Hz": PERIODS / (last - first)}
    for name, unit, values in (("ux", "_m", columns["A displacement x"]), ("uy", "_m", rise),
                               ("drag", "", force(columns, "x")), ("lift", "", force(columns, "y"))):
        chosen = [value for time, value in zip(times, values) if first <= time <= last]
        result[f"{name}_mean{unit}"] = (max(chosen) + min(chosen)) / 2
        result[f"{name}_amp{unit}"] = (max(chosen) - min(chosen)) / 2
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--case", choices=CASES, default="FSI2")
    parser.add_argument("--cells")
    parser.add_argument("--step")
    parser.add_argument("--end")
    parser.add_argument("--results")
    options = parser.parse_args()
    if options.results:
        columns = columns_of(options.results)
    else:
        given = (("Domain/Cells", options.cells), ("Time/Step", options.step), ("Time/End", options.end))
        scene = os.path.join(ROOT, "prm", f"turek_hron_{options.case.lower()}.prm")
        run = time_integration.once(options.program, scene, [f"{key}={value}" for key, value in given if value] + [
            "Output/Parts=statistics", "Output/Interval=0"])
        if run.complaint:
            sys.exit(f"turek_hron_swinging_flag.py: {run.complaint}")
        columns = run.columns
        print(f"{run.seconds:.0f} core seconds")
    reference = os.path.join(ROOT, "tests", "reference", f"turek_hron_{options.case.lower()}.csv")
    with open(reference) as file:
        published = next(line for line in csv.DictReader(line for line in file if not line.startswith("#"))
                         if line["case"] == options.case and line["level"] == "4+0")
    print("| figure | computed | published | difference |\n|---|---|---|---|")
    for name, value in figures(columns).items():
        wanted = float(published[name])
        print(f"| {name} | {value:.4g} | {wanted:.4g} | {100 * (value / wanted - 1):+.1f} % |")


if __name__ == "__main__":
    main()
