#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies and fluid solved together or in turns: which steps hold, and how the energies of those that do not grow.

usage: benchmarks/splitting.py [PROGRAM] [--out DIR] [--study NAME]... [--jobs N]

Makes the runs of the studies prm/studies/splitting_NAME.prm, or takes those that are there, and writes splitting.md
(tables) and splitting.png (energies over time) to DIR (default: output/studies). Half an hour on one processor without the
study 'search', which is left out unless it is named.
"""
import argparse
import math
import os
import sys

import numpy

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, ROOT)
from study import campaign, columns, tables  # noqa: E402

NAMES = ("stiff", "stiff_light", "light", "rubber_in_water", "heavy")
SHAKING = 10  # times the largest kinetic energy of the reference


def energies(run):
    """Kinetic ones of the bodies [J]."""
    return run["columns"]["solid kinetic energy"]


def last_quarter(run):
    """Mean kinetic energy of the bodies in the last quarter of the steps."""
    return energies(run)[-max(1, len(energies(run)) // 4):].mean()


def growth(run):
    """Factor of kinetic energy per step, from the mean of the first half to that of the second."""
    rows = energies(run)[1:]
    half = len(rows) // 2
    return (rows[-half:].sum() / rows[:half].sum()) ** (1 / half) if half and rows[:half].any() else math.nan


def verdict(run, reference):
    if run["result"]["failure"]:
        return "stops"
    return "holds" if last_quarter(run) <= SHAKING * energies(reference).max() else "shakes"


def measure(options, name):
    """The study, and {case: its result and columns}, coarse steps first."""
    file = os.path.join(ROOT, "prm", "studies", f"splitting_{name}.prm")
    study, results, folders = campaign.of_file(options.program, file, os.path.join(options.out, f"splitting_{name}"),
                                               options.jobs)
    return study, {case: {"result": results[case], "columns": columns.read(os.path.join(folders[case], "statistics"))}
                   for case in sorted(results, key=lambda case: case.index)}


def runs_table(study, runs):
    """A row for each run; of those of the same scene the one of the first scheme with the shortest step that ended is the
    reference."""
    ended = {case.index[2:]: run for case, run in runs.items() if case.index[0] == 0 and not run["result"]["failure"]}
    rows = []
    for case, run in runs.items():
        reference = ended.get(case.index[2:], run)
        until = run["columns"]["Time"][-1]
        failed = run["result"]["failure"]
        rows.append([*(variation.names[k] for variation, k in zip(study.variations, case.index)), verdict(run, reference),
                     f"{until:.3f}", f"{energies(run).max():.1e}", f"{last_quarter(run):.1e}", f"{growth(run):#.4g}",
                     f"{run['columns']['first_tip displacement x'][-1]:.4f}",
                     "" if failed else f"{run['result']['core seconds'] / until:.2f}", tables.reason(run["result"])])
    return tables.table([*(variation.name for variation in study.variations), "verdict", "until [s]",
                         "kinetic energy, largest [J]", "in the last quarter [J]", "factor per step", "tip at the end [m]",
                         "core s per simulated s", "what the program says"], rows)


def differences(study, runs):
    """Of tips between two schemes with the same step, at the times that all steps share, over the largest displacement."""
    schemes, steps = (variation.names for variation in study.variations[:2])
    found = {case.index: run["columns"] for case, run in runs.items()}
    rows = []
    for tip in ("first_tip displacement x", "second_tip displacement x"):
        for one, other in ((0, 1), (0, 2), (1, 2)):
            pairs = [[found[scheme, step][tip][::2 ** step] for scheme in (one, other)] for step in range(len(steps))]
            values = [numpy.abs(x - y).max() / numpy.abs(x).max() if len(x) == len(y) else math.nan for x, y in pairs]
            rows.append([tip, f"{schemes[one]}, {schemes[other]}", *(f"{value:.2e}" for value in values),
                         ", ".join(f"{a / b:.2f}" for a, b in zip(values, values[1:]))])
    return tables.table(["tip", "schemes", *steps, "ratios"], rows)


def plot(results, file):
    """Energies of the sheets over time: kinetic (full), elastic (dotted); x: the run stops."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(len(results), 3, figsize=(11, 2.6 * len(results)), sharey="row", sharex="row",
                                   squeeze=False)
    for row, (name, (study, runs)) in zip(axes, results.items()):
        peak = energies(next(iter(runs.values()))).max()
        row[0].set(ylim=(1e-6 * peak, 1e7 * peak), ylabel=f"{name}\nenergy [J]")
        for case, run in runs.items():
            axis, colour, times = row[case.index[0]], f"C{case.index[1]}", run["columns"]["Time"][1:]
            axis.set(yscale="log", title=study.variations[0].names[case.index[0]])
            axis.plot(times, energies(run)[1:], color=colour, lw=1, label=f"{study.variations[1].names[case.index[1]]} s")
            axis.plot(times, run["columns"]["solid elastic energy"][1:], color=colour, lw=0.7, ls=":")
            if run["result"]["failure"] and len(times):
                axis.plot(times[-1], min(energies(run)[-1], 0.5e7 * peak), "x", color=colour, ms=8, mew=2)
    axes[0][0].legend(fontsize=8, ncol=2)
    figure.tight_layout()
    figure.savefig(file, dpi=75)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--out", default=os.path.join("output", "studies"))
    parser.add_argument("--study", action="append", choices=(*NAMES, "search"))
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    results = {name: measure(options, name) for name in options.study or NAMES}
    lines = []
    for name, (study, runs) in results.items():
        lines += [f"## {study.title}", "", *runs_table(study, runs), *(differences(study, runs) if name == "heavy" else [])]
    with open(os.path.join(options.out, "splitting.md"), "w") as file:
        file.write("\n".join(lines))
    print("\n".join(lines))
    results.pop("search", None)
    if results:
        plot(results, os.path.join(options.out, "splitting.png"))


if __name__ == "__main__":
    main()
