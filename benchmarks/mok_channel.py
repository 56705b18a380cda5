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
import csv
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "tests", "checks"), os.path.join(ROOT, "benchmarks")]
import scene_tools  # noqa: E402
import time_integration  # noqa: E402

SCENE = os.path.join(ROOT, "prm", "mok_channel.prm")
REFERENCE = os.path.join(ROOT, "tests", "reference", "mok_channel_wall.csv")
FITTED = os.path.join(ROOT, "tests", "reference", "mok_channel_fitted.csv")
TIMES = {"ux_cm_at_3s": 3, "ux_cm_at_5s": 5, "ux_cm_at_15s": 15, "ux_cm_at_25s": 25}
FRICTION = {"ground_friction_N_at_3s": 3}
# Of the value on the fitted mesh: what grids of 120 by 53 and 150 by 66 cells are off by, and a little more.
MARGINS = {"peak_cm": 0.04, "ux_cm_at_3s": 0.02, "ux_cm_at_5s": 0.02, "ux_cm_at_15s": 0.04, "ux_cm_at_25s": 0.03,
           "ground_friction_N_at_3s": 0.03}


def columns_of(folder):
    names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    return dict(zip(names, zip(*rows)))


def at(times, values, time):
    """Linear between steps."""
    for t0, t1, a, b in zip(times, times[1:], values, values[1:]):
        if t1 >= time * (1 - 1e-12):
            return a + (b - a) * (time - t0) / (t1 - t0)
    sys.exit(f"mok_channel.py: the run ends at {times[-1]} s")


def figures(columns):
    """{name: value}, named as in the reference."""
    times, way = columns["Time"], columns["A displacement x"]
    ground = [side + slope for side, slope in zip(columns["Viscous force on floor, x"], columns["viscous force floor x"])]
    result = {"peak_cm": 100 * max(way), "t_peak_s": times[way.index(max(way))]}
    result.update({name: 100 * at(times, way, time) for name, time in TIMES.items()})
    result.update({name: at(times, ground, time) for name, time in FRICTION.items()})
    return result


def rows(file):
    with open(file) as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def draw(columns, published, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    pyplot.figure(figsize=(7, 4))
    pyplot.plot(columns["Time"], [100 * x for x in columns["A displacement x"]], label="Undine")
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
    if options.results:
        columns = columns_of(options.results)
    else:
        run = time_integration.once(options.program, SCENE, [
            f"Domain/Cells={options.cells}", f"Time/Step={options.step}", "Output/Parts=statistics", "Output/Interval=0"])
        if run.complaint:
            sys.exit(f"mok_channel.py: {run.complaint}")
        columns = run.columns
        print(f"{run.seconds:.0f} core seconds")
    published = rows(REFERENCE)
    fitted = {line["quantity"]: float(line["value"]) for line in rows(FITTED)}
    failed = False
    print("| figure | computed | fitted mesh | difference | allowed | published |\n|---|---|---|---|---|---|")
    for name, value in figures(columns).items():
        others = [float(line[name]) for line in published if name in line]
        line = f"| {name} | {value:.3g} | "
        if name in MARGINS:
            error = value / fitted[name] - 1
            failed = failed or not abs(error) <= MARGINS[name]
            line += f"{fitted[name]:.3g} | {100 * error:+.1f} % | {100 * MARGINS[name]:.0f} %"
        else:
            line += "| |"
        print(line + (f" | {min(others):.2f} to {max(others):.2f} |" if others else " | |"))
    if options.picture:
        draw(columns, published, options.picture)
    sys.exit(1 if options.check and failed else 0)


if __name__ == "__main__":
    main()
