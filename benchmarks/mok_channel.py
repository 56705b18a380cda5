#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The flexible wall in Mok's converging channel, against the published way of its tip.

usage: benchmarks/mok_channel.py [PROGRAM] [--cells "90, 40"] [--step 1/10] [--results DIR] [--picture FILE.png] [--check]

Prints the largest displacement of the tip along the channel, when it is reached, and the displacements at 5, 15 and 25 s,
with the least and the largest published value; core seconds. --results: take these results instead of running. --picture:
draw the way of the tip (needs the Debian package python3-matplotlib). --check: exit code 1 if the largest or the last
displacement is more than 5 % beyond the published ones. One rank; a minute with the scene's own grid and step.
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
TIMES = {"ux_cm_at_5s": 5, "ux_cm_at_15s": 15, "ux_cm_at_25s": 25}
BOUNDED = ("peak_cm", "ux_cm_at_25s")
MARGIN = 0.05


def columns_of(folder):
    names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    return dict(zip(names, zip(*rows)))


def at(columns, time):
    """Displacement along the channel, linear between steps [cm]."""
    times, way = columns["Time"], columns["A displacement x"]
    for t0, t1, a, b in zip(times, times[1:], way, way[1:]):
        if t1 >= time * (1 - 1e-12):
            return 100 * (a + (b - a) * (time - t0) / (t1 - t0))
    sys.exit(f"mok_channel.py: the run ends at {times[-1]} s")


def figures(columns):
    """{name: value}, named as in the reference."""
    largest = max(columns["A displacement x"])
    result = {"peak_cm": 100 * largest,
              "t_peak_s": columns["Time"][columns["A displacement x"].index(largest)]}
    result.update({name: at(columns, time) for name, time in TIMES.items()})
    return result


def draw(columns, published, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    pyplot.figure(figsize=(7, 4))
    pyplot.plot(columns["Time"], [100 * x for x in columns["A displacement x"]], label="Undine")
    for mark, line in zip("osd", published):
        places = [(float(line["t_peak_s"]), float(line["peak_cm"]))]
        places += [(time, float(line[name])) for name, time in TIMES.items()]
        pyplot.plot(*zip(*places), mark, label=line["source"])
    pyplot.xlabel("time [s]")
    pyplot.ylabel("tip's displacement [cm]")
    pyplot.legend()
    pyplot.tight_layout()
    pyplot.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--cells", default="90, 40")
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
    with open(REFERENCE) as file:
        published = list(csv.DictReader(line for line in file if not line.startswith("#")))
    failed = False
    print("| figure | computed | published |\n|---|---|---|")
    for name, value in figures(columns).items():
        least, largest = (choose(float(line[name]) for line in published) for choose in (min, max))
        if name in BOUNDED:
            failed = failed or not (1 - MARGIN) * least <= value <= (1 + MARGIN) * largest
        print(f"| {name} | {value:.2f} | {least:.2f} to {largest:.2f} |")
    if options.picture:
        draw(columns, published, options.picture)
    sys.exit(1 if options.check and failed else 0)


if __name__ == "__main__":
    main()
