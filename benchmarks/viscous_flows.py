#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Steady viscous flows against published figures: the lid-driven cavity and the heated cavity.

usage: benchmarks/viscous_flows.py [PROGRAM] [--case NAME]... [--check]

Prints a table: extrema of the velocities on the centre lines of the cavity at Reynolds numbers 100, 400 and 1000; mean
Nusselt number of the hot wall and largest velocities on the centre lines at Rayleigh numbers 1e3, 1e4 and 1e5. --check:
exit code 1 if a figure is farther than its bound from the published one. One rank, one to five minutes a case.
"""
import argparse
import csv
import math
import os
import sys
import tempfile
from dataclasses import dataclass

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "tests", "checks")]
import scene_tools  # noqa: E402

REFERENCE = os.path.join(ROOT, "tests", "reference")
GRADING = "x-0.7*sin(2*pi*x)/(2*pi)"
# Ghia, Ghia, Shin (1982) at Reynolds number 400, the entry known to be misprinted left out: on a grid of 129 by 129.
GHIA_400 = {"u_min": -0.32726, "v_max": 0.30203, "v_min": -0.44993}


@dataclass
class Case:
    """A scene, the cells on a side, what is changed, and by which share figures may differ."""
    scene: str
    cells: int
    settings: list
    bound: float


def cavity(reynolds, cells, end):
    return Case("prm/cavity.prm", cells, [f"Effects/viscosity/Dynamic viscosity={1 / reynolds}", "Time/Step=0.05",
                                          f"Time/End={end}"], 0.01)


def heated(rayleigh, cells, step):
    return Case("prm/heated_cavity.prm", cells, [
        f"Effects/buoyancy/heat/Expansion coefficient={0.71 * rayleigh}", f"Time/Step={step}", "Time/End=0.5"], 0.02)


CASES = {
    "cavity, Re 100": cavity(100, 48, 20),
    "cavity, Re 400": cavity(400, 64, 40),
    "cavity, Re 1000": cavity(1000, 96, 60),
    "heated cavity, Ra 1e3": heated(1e3, 32, 0.01),
    "heated cavity, Ra 1e4": heated(1e4, 32, 0.005),
    "heated cavity, Ra 1e5": heated(1e5, 48, 0.002),
}


def centres(cells):
    planes = [s - 0.7 * math.sin(2 * math.pi * s) / (2 * math.pi) for s in (i / cells for i in range(cells + 1))]
    return [(a + b) / 2 for a, b in zip(planes, planes[1:])]


def probe(name, x, y):
    return f"  subsection {name}\n    set Kind  = fluid point\n    set Point = {x:.15g}, {y:.15g}\n  end\n"


def last_row(program, case):
    """{column: value} at the end, with probes at the lattice's own points on both centre lines and along the wall."""
    places = centres(case.cells)
    with open(os.path.join(ROOT, case.scene)) as file:
        text = file.read()
    text += "\nsubsection Probes\n" + "".join(
        probe(f"u{k}", 0.5, place) + probe(f"v{k}", place, 0.5) + probe(f"wall{k}", places[0], place) +
        probe(f"next{k}", places[1], place) for k, place in enumerate(places)) + "end\n"
    settings = case.settings + [f"Domain/Cells={case.cells}, {case.cells}", f"Domain/Grading x={GRADING}",
                                f"Domain/Grading y={GRADING}", "Output/Parts=statistics", "Output/Interval=0"]
    with tempfile.TemporaryDirectory() as folder:
        scene = os.path.join(folder, "scene.prm")
        with open(scene, "w") as file:
            file.write(text)
        arguments = [scene, "--output", os.path.join(folder, "results")]
        for setting in settings:
            arguments += ["--set", setting]
        scene_tools.run(program, arguments)
        names, _, rows = scene_tools.parse(scene_tools.statistics(os.path.join(folder, "results")))
    return dict(zip(names, rows[-1]))


def extrema(places, values):
    """Smallest and largest value of the parabolas through three neighbours each."""
    smallest, largest = min(values), max(values)
    for (a, b, c), (fa, fb, fc) in zip(zip(places, places[1:], places[2:]), zip(values, values[1:], values[2:])):
        below, above = (fb - fa) / (b - a), (fc - fb) / (c - b)
        curvature = (above - below) / (c - a)
        slope = below + curvature * (b - a)
        if curvature and a - b <= -slope / (2 * curvature) <= c - b:
            value = fb - slope * slope / (4 * curvature)
            smallest, largest = min(smallest, value), max(largest, value)
    return smallest, largest


def lines(row, cells):
    u = extrema(centres(cells), [row[f"u{k} velocity x"] for k in range(cells)])
    v = extrema(centres(cells), [row[f"v{k} velocity y"] for k in range(cells)])
    return u, v


def nusselt(row, cells):
    """Mean slope at the hot wall of the parabola through it (1) and the two nearest cells."""
    places = centres(cells)
    planes = [0] + [s - 0.7 * math.sin(2 * math.pi * s) / (2 * math.pi)
                    for s in ((k + 1) / cells for k in range(cells))]
    a, b = places[:2]
    total = 0
    for k in range(cells):
        first, second = (row[f"wall{k} heat"] - 1) / a, (row[f"next{k} heat"] - 1) / b
        total += (first + (first - second) / (b - a) * a) * (planes[k] - planes[k + 1])
    return total


def table(name):
    with open(os.path.join(REFERENCE, name)) as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def figures(name, row, cells):
    """[(what, computed, published)]"""
    u, v = lines(row, cells)
    number = name.split()[-1]
    if name.startswith("cavity"):
        wanted = {entry["quantity"]: float(entry["value"]) for entry in table("cavity_extrema.csv")
                  if entry["source"] == "botella-peyret" and entry["Re"] == number} or GHIA_400
        return [("u_min", u[0], wanted["u_min"]), ("v_max", v[1], wanted["v_max"]), ("v_min", v[0], wanted["v_min"])]
    entry = next(row for row in table("natural_convection_cavity.csv") if float(row["Ra"]) == float(number))
    return [("Nu", nusselt(row, cells), float(entry["Nu_mean"])), ("u_max", u[1], float(entry["u_max"])),
            ("v_max", v[1], float(entry["v_max"]))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--case", action="append", choices=CASES)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    failed = False
    print("| case | cells | figure | computed | published | difference |\n|---|---|---|---|---|---|")
    for name in options.case or CASES:
        case = CASES[name]
        for what, computed, published in figures(name, last_row(options.program, case), case.cells):
            difference = computed / published - 1
            failed = failed or not abs(difference) <= case.bound
            print(f"| {name} | {case.cells}² | {what} | {computed:.5g} | {published:.5g} | {100 * difference:+.2f} % |",
                  flush=True)
    sys.exit(1 if options.check and failed else 0)


if __name__ == "__main__":
    main()
