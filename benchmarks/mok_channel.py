#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The flexible wall in Mok's converging channel, against the way of its tip by another method and as published.

usage: benchmarks/mok_channel.py [PROGRAM] [--cells "120, 53"] [--step 1/10] [--results DIR] [--picture FILE.png] [--check]

Prints the largest displacement of the tip along the channel, when it is reached, the displacements at 3, 5, 15 and 25 s
and the friction on the ground at 3 s, with the values on a mesh that fits the wall (mok_channel_fitted.edp) and the
least and largest published ones, which are read off a figure and lie where coarse grids do (doc/viscous_flows.md); core
seconds. --results: take these results instead of running. --picture: draw the way of the tip (needs the Debian package
python3-matplotlib). --check: exit code 1 if a figure is farther from that of the fitted mesh than MARGINS allows. One
rank; a minute with the scene's own grid and step.
"""
import argparse
import os
import sys

import numpy

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, ROOT)
from study import columns as of_run, references, runs, tables  # noqa: E402

REFERENCE = os.path.join(ROOT, "tests", "reference")
TIMES = {"ux_cm_at_3s": 3, "ux_cm_at_5s": 5, "ux_cm_at_15s": 15, "ux_cm_at_25s": 25}
# Of the value on the fitted mesh: what grids of 120 by 53 and 150 by 66 cells are off by, and a little more.
MARGINS = {"peak_cm": 0.04, "ux_cm_at_3s": 0.02, "ux_cm_at_5s": 0.02, "ux_cm_at_15s": 0.04, "ux_cm_at_25s": 0.03,
           "ground_friction_N_at_3s": 0.03}


def measure(options):
    """Columns of a run, or of results that are there."""
    if options.results:
        return of_run.read(os.path.join(options.results, "statistics"))
    result, columns = runs.single(options.program, os.path.join(ROOT, "prm", "mok_channel.prm"),
                                  {"Domain/Cells": options.cells, "Time/Step": options.step})
    if result["failure"]:
        sys.exit(f"mok_channel.py: {result['failure']}")
    print(f"{result['core seconds']:.0f} core seconds")
    return columns


def figures(columns):
    """{name: value}, named as in the reference."""
    times, way = columns["Time"], columns["A displacement x"]
    if times[-1] < max(TIMES.values()) * (1 - 1e-12):
        sys.exit(f"mok_channel.py: the run ends at {times[-1]} s")
    ground = columns["Viscous force on floor, x"] + columns["viscous force floor x"]
    return {"peak_cm": 100 * way.max(), "t_peak_s": times[way.argmax()],
            **{name: 100 * numpy.interp(time, times, way) for name, time in TIMES.items()},
            "ground_friction_N_at_3s": numpy.interp(3, times, ground)}


def draw(columns, published, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    pyplot.figure(figsize=(7, 4))
    pyplot.plot(columns["Time"], 100 * columns["A displacement x"], label="Undine")
    for mark, line in zip("osd", published):
        places = [(float(line["t_peak_s"]), float(line["peak_cm"]))]
        places += [(time, float(line[name])) for name, time in TIMES.items() if name in line]
        pyplot.plot(*zip(*places), mark, label=line["source"])
    pyplot.xlabel("time [s]")
    pyplot.ylabel("tip's displacement [cm]")
    pyplot.legend()
    pyplot.tight_layout()
    pyplot.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--cells", default="120, 53")
    parser.add_argument("--step", default="1/10")
    parser.add_argument("--results")
    parser.add_argument("--picture")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    columns = measure(options)
    published = references.table(os.path.join(REFERENCE, "mok_channel_wall.csv"))
    fitted = {line["quantity"]: float(line["value"])
              for line in references.table(os.path.join(REFERENCE, "mok_channel_fitted.csv"))}
    rows, failed = [], False
    for name, value in figures(columns).items():
        others = [float(line[name]) for line in published if name in line]
        cells = ["", "", ""]
        if name in MARGINS:
            error = value / fitted[name] - 1
            failed = failed or not abs(error) <= MARGINS[name]
            cells = [f"{fitted[name]:.3g}", f"{100 * error:+.1f} %", f"{100 * MARGINS[name]:.0f} %"]
        rows.append([name, f"{value:.3g}", *cells, f"{min(others):.2f} to {max(others):.2f}" if others else ""])
    print("\n".join(tables.table(["figure", "computed", "fitted mesh", "difference", "allowed", "published"], rows)))
    if options.picture:
        draw(columns, published, options.picture)
    sys.exit(1 if options.check and failed else 0)


if __name__ == "__main__":
    main()
