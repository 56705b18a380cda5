#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Seconds per step by phase, for three sizes of the solid alone, of the fluid alone, with and
without obstacles, and of both together, by either scheme, on 1 and 2 ranks, as Markdown tables
(doc/costs.md holds those of one machine).

usage: benchmarks/cost_table.py [PROGRAM] [--smallest]

--smallest takes the first of the three sizes alone, and leaves out what follows these tables.

Beside PROGRAM tests/geometry_benchmark is expected, which './undine test' builds: it measures the projection of
a million cells and the cutting of a grid.
Nothing else should run meanwhile.
"""
import os
import platform
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "checks"))
import scene_tools  # noqa: E402

STEPS = 5


def sizes(key, *values):
    return [[f"{key}={value}"] for value in values]


def jet(scheme):
    """Grids, and sheets refined alike."""
    return [[f"Scheme={scheme}", f"Domain/Cells={grid}", f"Bodies/first/Cells={sheet}",
             f"Bodies/second/Cells={sheet}"]
            for grid, sheet in (("24, 12, 12", "1, 7, 4"), ("48, 24, 24", "1, 13, 8"),
                                ("72, 36, 36", "1, 20, 12"))]


# Title, scene, and what is set for each size.
CASES = [
    ("Solid alone: 3D cantilever, Q2 elements, theta integrator", "prm/cantilever.prm",
     sizes("Bodies/beam/Cells", "20, 2, 4", "32, 4, 6", "48, 6, 10")),
    ("Fluid alone: 3D plume, two scalars", "prm/plume.prm",
     sizes("Domain/Cells", "32, 64, 32", "50, 100, 50", "80, 156, 80")),
    ("Fluid past a fixed ball: one scalar", "prm/ball_in_stream.prm",
     sizes("Domain/Cells", "60, 40, 40", "96, 64, 64", "150, 80, 80")),
    ("Fluid past a ball that moves", "tests/resume/ball.prm",
     sizes("Domain/Cells", "60, 40, 40", "96, 64, 64", "150, 80, 80")),
    ("A jet and two sheets, Q2 elements: simultaneous", "prm/jet_two_sheets.prm",
     jet("simultaneous")),
    ("The same by time splitting", "prm/jet_two_sheets.prm", jet("time_splitting")),
]


def phases(folder):
    """{phase path: seconds} from the file `timing`, nested phases joined by ' / '."""
    result, above = {}, []
    with open(os.path.join(folder, "timing")) as file:
        for line in file:
            row = re.match(r"( *)(\S.*?) +(\d+) +([\d.]+) +([\d.]+)$", line.rstrip())
            if row:
                above = above[:len(row[1]) // 2] + [row[2]]
                result[" / ".join(above)] = float(row[4])
    return result


def measure(program, scene, assignments, ranks):
    with tempfile.TemporaryDirectory() as folder:
        arguments = [os.path.join(ROOT, scene), "--output", folder]
        for assignment in assignments + ["Output/Interval=0", "Output/Parts=statistics",
                                         f"Time/Maximum steps={STEPS}", "Time/Integrator=theta"]:
            arguments += ["--set", assignment]
        result = scene_tools.run(program, arguments, ranks)
        size = re.findall(r"(?:fluid|bodies): (.*)", result.stdout)
        return ", ".join(size), phases(folder)


def step_alone(seconds):
    """Of the outermost phases without the start [s]."""
    return sum(value for name, value in seconds.items()
               if " / " not in name and name != "initialise")


def table(program, title, scene, values):
    columns, labels = [], []
    for value in values:
        for ranks in (1, 2):
            size, seconds = measure(program, scene, value, ranks)
            columns.append((ranks, seconds))
            labels.append(size)
    print(f"\n## {title}\n\n{STEPS} steps of `{scene}`; seconds per step, `initialise` once.\n")
    print("| phase | " + " | ".join(f"{size}, {ranks} rank{'s' if ranks > 1 else ''}"
                                   for size, (ranks, _) in zip(labels, columns)) + " |")
    print("|---" * (len(columns) + 1) + "|")
    names = list(dict.fromkeys(name for _, seconds in columns for name in seconds))
    for name in names:
        once = name.startswith("initialise")
        cells = [seconds.get(name, 0) / (1 if once else STEPS) for _, seconds in columns]
        if max(cells) >= 0.001:
            label = "&nbsp;&nbsp;" * name.count(" / ") + name.split(" / ")[-1]
            print(f"| {label} | " + " | ".join(f"{cell:.3f}" for cell in cells) + " |")
    print("| **a step** | " + " | ".join(f"{step_alone(seconds) / STEPS:.3f}"
                                         for _, seconds in columns) + " |")
    sys.stdout.flush()


def projections(benchmark):
    """The projections of a million cells from noise, on 1 and 2 ranks."""
    print("\n## Projection of a million cells\n\nFrom a velocity of noise to a divergence of 1e-10; "
          "seconds. The setup is done once in a run.\n")
    print("| grid | ranks | setup | solve | iterations |\n|---|---|---|---|---|")
    for ranks in (1, 2):
        text = scene_tools.run(benchmark, ["a projection of a million cells*"], ranks).stdout
        for row in re.findall(r"([23]D .*?) +\d+ cells, setup +([\d.]+) s, solve +([\d.]+) s, (\d+)",
                              text):
            print(f"| {row[0]} | {ranks} | {row[1]} | {row[2]} | {row[3]} |")


def cuts(benchmark):
    """A ball of more and more facets cuts finer and finer grids, on one rank."""
    print("\n## Cutting a grid\n\nA ball of diameter 0.7 in a unit cube (square in 2D); one rank.\n")
    print("| cells along an edge | facets | cut cells | ms | µs per facet | µs per cut cell |\n"
          "|---|---|---|---|---|---|")
    text = scene_tools.run(benchmark, ["a ball of more and more facets*"], 1).stdout
    for row in re.findall(r"([23]D) +(\d+) cells along an edge, +(\d+) facets, +(\d+) cut cells: +"
                          r"([\d.]+) ms, +([\d.]+) us per facet, +([\d.]+) us", text):
        print(f"| {row[0]}, {row[1]} | " + " | ".join(row[2:]) + " |")


def main():
    given = [argument for argument in sys.argv[1:] if not argument.startswith("--")]
    program = given[0] if given else os.path.join(ROOT, "build", "undine")
    smallest = "--smallest" in sys.argv
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout.strip()
    print(f"# What a step costs\n\nWritten by `benchmarks/cost_table.py`: {version}, "
          f"{os.cpu_count()} cores ({platform.machine()}). Steps are those of\n`Time / Integrator = theta`, "
          "of one stage; the default has two, each of these costs.")
    for title, scene, values in CASES:
        table(program, title, scene, values[:1] if smallest else values)
    if smallest:
        return
    benchmark = os.path.join(os.path.dirname(program), "tests", "geometry_benchmark")
    projections(benchmark)
    cuts(benchmark)


main()
