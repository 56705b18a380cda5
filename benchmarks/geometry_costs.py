#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Seconds that projections of a million cells and the cutting of a grid take, as Markdown tables: doc/costs.md holds those
of one machine, and names the studies that measure seconds per step by phase.

usage: benchmarks/geometry_costs.py [PROGRAM]

PROGRAM is geometry_benchmark, which './undine test' builds (default: build/tests/geometry_benchmark). Nothing else should
run meanwhile.
"""
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "checks"))
import scene_tools  # noqa: E402


def projections(program):
    """The projections of a million cells from noise, on 1 and 2 ranks."""
    print("\n## Projection of a million cells\n\nFrom a velocity of noise to a divergence of 1e-10; "
          "seconds. The setup is done once in a run.\n")
    print("| grid | ranks | setup | solve | iterations |\n|---|---|---|---|---|")
    for ranks in (1, 2):
        text = scene_tools.run(program, ["a projection of a million cells*"], ranks).stdout
        for row in re.findall(r"([23]D .*?) +\d+ cells, setup +([\d.]+) s, solve +([\d.]+) s, (\d+)", text):
            print(f"| {row[0]} | {ranks} | {row[1]} | {row[2]} | {row[3]} |")


def cuts(program):
    """A ball of more and more facets cuts finer and finer grids, on one rank."""
    print("\n## Cutting a grid\n\nA ball of diameter 0.7 in a unit cube (square in 2D); one rank.\n")
    print("| cells along an edge | facets | cut cells | ms | µs per facet | µs per cut cell |\n" + 6 * "|---" + "|")
    text = scene_tools.run(program, ["a ball of more and more facets*"], 1).stdout
    for row in re.findall(r"([23]D) +(\d+) cells along an edge, +(\d+) facets, +(\d+) cut cells: +"
                          r"([\d.]+) ms, +([\d.]+) us per facet, +([\d.]+) us", text):
        print(f"| {row[0]}, {row[1]} | " + " | ".join(row[2:]) + " |")


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "build", "tests", "geometry_benchmark")
    projections(program)
    cuts(program)


if __name__ == "__main__":
    main()
