#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Seconds, memory and messages of a step over numbers of ranks: strong scaling, and weak scaling with --weak.

usage: benchmarks/scaling.py PROGRAM [--ranks 1,2,4] [--scenes jet,plume,box] [--steps N] [--weak [only]] [--output FOLDER]
                             [--mpirun "mpirun --bind-to core"] [--repeat N] [--no-messages] [--cells N] [--limit SECONDS]
       benchmarks/scaling.py --plot FILE.csv... [--output FOLDER]

Scenes are a jet with two sheets (jet_28k, jet_221k, jet_1m; jet: all three), a plume and a lid-driven box, each of a million
cells. With --weak, cells and bodies' elements grow with the ranks from a size for each, by finer grids with steps as
much shorter. --cells takes another number of cells, for each rank with --weak.
Writes scaling.md (tables, also printed), scaling.csv (all numbers, as they come), scaling_strong and scaling_weak (.svg, .png)
to FOLDER (default: output/scaling); --plot does so from files of earlier runs. Messages are counted in runs apart, by the
monitoring of Open MPI, if there is such. Nothing else should run meanwhile.
"""
import argparse
import collections
import os

import scaling_model
import step_costs
from step_costs import SECONDS, STEP

# A scene: its file, its grid, elements of each sheet upwards and across (none: no sheets), its step [s]; and the grid and
# elements of a rank with weak scaling.
Scene = collections.namedtuple("Scene", "file grid elements step rank_grid rank_elements")
JET = ("jet_two_sheets.prm", 1 / 30, (48, 24, 24), (10, 6))
SCENES = {
    "jet_28k": Scene(JET[0], (48, 24, 24), (10, 6), *JET[1:]),
    "jet_221k": Scene(JET[0], (96, 48, 48), (20, 12), *JET[1:]),
    "jet_1m": Scene(JET[0], (160, 80, 80), (40, 24), *JET[1:]),
    "plume": Scene("plume.prm", (80, 160, 80), (), 1 / 30, (32, 64, 32), ()),
    "box": Scene("studies/scenes/lid_driven_box.prm", (100, 100, 100), (), 0.02, (40, 40, 40), ()),
}
GROUPS = {"jet": ("jet_28k", "jet_221k", "jet_1m")}
RUN = ("kind", "scene", "ranks", "cells", "elements", "steps")
FAILURE = ("failure", "")


def product(numbers):
    result = 1
    for number in numbers:
        result *= number
    return result


def scaled(numbers, factor, even):
    """Numbers whose product is about as many times as large, in the same proportions."""
    each = factor ** (1 / len(numbers))
    return tuple(max(2, 2 * round(number * each / 2)) if even else max(1, round(number * each)) for number in numbers)


def sizes(scene, kind, ranks, cells):
    """Grid, elements of a sheet and step."""
    grid, elements = (scene.rank_grid, scene.rank_elements) if kind == "weak" else (scene.grid, scene.elements)
    factor = cells / product(grid) if cells else 1
    base = scaled(grid, factor, True) if cells else grid
    factor *= ranks if kind == "weak" else 1
    if factor == 1:
        return grid, elements, scene.step
    grid = scaled(grid, factor, True)
    step = scene.step * base[0] / grid[0] if kind == "weak" else scene.step
    return grid, scaled(elements, factor, False) if elements else (), step


def settings_of(grid, elements, step):
    result = {"Domain/Cells": ", ".join(map(str, grid)), "Time/Step": f"{step:.10g}"}
    for body in ("first", "second") if elements else ():
        result[f"Bodies/{body}/Cells"] = ", ".join(map(str, (1, *elements)))
    return result


def measured(program, options, kind, name, ranks):
    """The run, and its numbers."""
    scene = SCENES[name]
    grid, elements, step = sizes(scene, kind, ranks, options.cells)
    run = (kind, name, str(ranks), str(product(grid)), str(2 * product(elements) if elements else 0), str(options.steps))
    step_costs.say(f"{kind}, {name}, {ranks} rank(s), {product(grid)} cells")
    file, settings = os.path.join(step_costs.ROOT, "prm", scene.file), settings_of(grid, elements, step)
    try:
        values = step_costs.median([step_costs.measure(program, file, settings, ranks, options.steps)
                                    for _ in range(options.repeat)])
    except step_costs.Failure as failure:
        step_costs.say(f"  {failure}")
        return run, {FAILURE: str(failure)}
    step_costs.say(f"  {values[STEP, SECONDS]:.4g} s a step")
    if options.messages and ranks > 1:
        try:
            values.update(step_costs.messages(program, file, settings, ranks, options.steps))
        except step_costs.Failure as failure:
            step_costs.say(f"  messages are not counted: {failure}")
    return run, values


def by_scene(found):
    """{(kind, scene, cells if they are the same on all ranks): {ranks: (cells, numbers)}} of the runs that have some, and
    [(run, failure)]."""
    groups, failures = {}, []
    for run, values in found.items():
        if FAILURE in values:
            failures.append((run, values[FAILURE]))
        else:
            groups.setdefault((*run[:2], run[3] if run[0] == "strong" else ""), {})[int(run[2])] = int(run[3]), values
    order = sorted(groups, key=lambda key: (key[0], [*SCENES].index(key[1]), len(key[2]), key[2]))
    return {key: dict(sorted(groups[key].items())) for key in order}, failures


def title(key):
    _, scene, cells = key
    return scene.split("_")[0] + (f", {cells} cells" if cells else "")


def efficiencies(group):
    """{ranks: cells that a rank does in a second, over those with the fewest ranks}."""
    rates = {ranks: cells / ranks / max(1e-9, values[STEP, SECONDS]) for ranks, (cells, values) in group.items()}
    return {ranks: rate / rates[min(rates)] for ranks, rate in rates.items()}


def phases_of(values):
    return {quantity: value for (quantity, unit), value in values.items() if unit == SECONDS}


def summary_table(group):
    efficiency, rows = efficiencies(group), []
    for ranks, (cells, values) in group.items():
        get, number = values.get, step_costs.number
        sent = [get((f"{what} {kind}", STEP)) for what in ("messages", "bytes") for kind in ("of pairs", "of collectives")]
        rows.append([ranks, cells, f"{get(('unknowns', '1')):.0f}", number(values[STEP, SECONDS]), f"{100 * efficiency[ranks]:.0f} %",
                     f"{get(('peak memory', 'bytes')) / 1e6:.0f}", f"{get(('peak memory of an unknown', 'bytes')) / 1e3:.2f}",
                     *(number(value) for value in sent[:2]),
                     *("" if value is None else number(value / 1e6) for value in sent[2:])])
    return step_costs.table(["ranks", "cells", "unknowns", "s a step", "efficiency", "memory [MB]", "memory of an unknown [kB]",
                             "messages a step, of pairs", "of collectives", "MB sent a step, of pairs", "of collectives"], rows)


def phase_table(group):
    """Seconds of phases that matter on some number of ranks."""
    each = {ranks: phases_of(values) for ranks, (_, values) in group.items()}
    rows = []
    for name in dict.fromkeys(name for phases in each.values() for name in phases if name != STEP):
        if any(phases.get(name, 0) > step_costs.LEAST_SHARE * phases[STEP] for phases in each.values()):
            rows.append([step_costs.indented(name), *(f"{phases.get(name, 0):.4f}" for phases in each.values())])
    rows.append(["**a step**", *(f"{phases[STEP]:.4f}" for phases in each.values())])
    return step_costs.table(["seconds of a step by phase", *(f"{ranks} rank(s)" for ranks in each)], rows)


def model_lines(group):
    """Models of the parts of a step, and which of these would take the most on very many ranks."""
    most, far = max(group), scaling_model.FAR
    if len(group) < scaling_model.LEAST_RANKS:
        return [f"No model: it takes {scaling_model.LEAST_RANKS} numbers of ranks.", ""]
    measured_parts = {ranks: step_costs.parts(phases_of(values)) for ranks, (_, values) in group.items()}
    models = scaling_model.models(measured_parts)
    whole = {ranks: sum(scaling_model.seconds(model, ranks) for model in models.values()) for ranks in (most, far)}
    rows = []
    for name, model in sorted(models.items(), key=lambda item: -scaling_model.seconds(item[1], far)):
        shares = [scaling_model.seconds(model, ranks) / max(whole[ranks], 1e-300) for ranks in (most, far)]
        if max(shares) > step_costs.LEAST_SHARE:
            rows.append([name, *(f"{coefficient:.2e}" for coefficient in model), *(f"{100 * share:.0f} %" for share in shares)])
    lines = ["T(P) = a + b / P + c log2 P, least squares of relative errors, nothing negative:", ""]
    lines += step_costs.table(["part of a step", "a [s]", "b [s]", "c [s]", f"of a step, {most} ranks", f"{far} ranks"], rows)
    return lines + [f"First bottleneck of an extrapolation to {far} ranks from at most {most}: **{rows[0][0]}**, {rows[0][-1]} of a "
                    f"step of {whole[far]:.3g} s. This is an extrapolation of the model, not a measurement.", ""]


def report(found):
    """Markdown."""
    groups, failures = by_scene(found)
    lines = ["# Scaling", "", f"Seconds, memory and messages of a step without the first {step_costs.FIRST}. Seconds of phases are "
             "those of the first rank, with its waiting for others. Efficiency: cells that a rank does in a second, over those with the "
             "fewest ranks. Memory: sum over ranks of the largest of each. Unknowns: cells of the fluid and velocities of bodies. "
             "Messages: of all ranks, those between pairs and those that collective operations consist of.", ""]
    for key, group in groups.items():
        lines += [f"## {key[0].capitalize()} scaling: {title(key)}", "", *summary_table(group), *phase_table(group), *model_lines(group)]
        if max(group) > 1 and not any(("messages of pairs", STEP) in values for _, values in group.values()):
            lines += ["Messages were not counted: switched off, or this `mpirun` has no monitoring.", ""]
    if failures:
        lines += ["## Runs without a result", "", *(f"- {', '.join(run[:2])}, {run[2]} rank(s): {why}" for run, why in failures), ""]
    return "\n".join(lines)


def chosen(names, one_size):
    """Scenes; those of a group differ in their size only."""
    result = []
    for name in names.split(","):
        members = GROUPS.get(name, next((group for group in GROUPS.values() if one_size and name in group), (name,)))
        result += members[:1] if one_size else members
    return list(dict.fromkeys(result))


def make_runs(options, path):
    program = step_costs.Program(options.program, options.mpirun, options.limit, True)
    kinds = {None: ("strong",), "too": ("strong", "weak"), "only": ("weak",)}[options.weak]
    listing = step_costs.Listing(path, RUN)
    for kind in kinds:
        for name in chosen(options.scenes, kind == "weak" or options.cells):
            for ranks in options.ranks:
                listing.add(*measured(program, options, kind, name, ranks))
    listing.close()


def numbers(text):
    return sorted({int(word) for word in text.split(",")})


def powers_of_two():
    return ",".join(str(2**k) for k in range(len(os.sched_getaffinity(0)).bit_length()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("--ranks", type=numbers, default=powers_of_two(), help="default: powers of two up to the processors")
    parser.add_argument("--scenes", default="jet,plume,box", help=f"of {', '.join([*GROUPS, *SCENES])}")
    parser.add_argument("--steps", type=int, default=5, help="that count, after the first two")
    parser.add_argument("--weak", nargs="?", const="too", choices=("too", "only"))
    parser.add_argument("--output", metavar="FOLDER", default=os.path.join("output", "scaling"))
    parser.add_argument("--mpirun", default="mpirun", help="with its options, '-n RANKS' is added")
    parser.add_argument("--repeat", type=int, default=1, help="medians of so many measurements")
    parser.add_argument("--no-messages", dest="messages", action="store_false")
    parser.add_argument("--cells", type=int, help="instead of those of the scenes")
    parser.add_argument("--limit", type=float, default=0, help="of a run [s]; 0: none")
    parser.add_argument("--plot", nargs="+", metavar="FILE.csv", help="of earlier runs: tables and plots from them")
    options = parser.parse_args()
    unknown = set(options.scenes.split(",")) - {*GROUPS, *SCENES}
    if bool(options.program) == bool(options.plot) or unknown:
        parser.error(f"no scenes: {', '.join(unknown)}" if unknown else "either a program or --plot")
    os.makedirs(options.output, exist_ok=True)
    if options.program:
        options.plot = [os.path.join(options.output, "scaling.csv")]
        make_runs(options, options.plot[0])
    found = step_costs.read_listing(options.plot)
    step_costs.write_report(report(found), os.path.join(options.output, "scaling.md"))
    groups, _ = by_scene(found)
    for kind in dict.fromkeys(key[0] for key in groups):
        lines = {title(key): {ranks: (values[STEP, SECONDS], efficiencies(group)[ranks]) for ranks, (_, values) in group.items()}
                 for key, group in groups.items() if key[0] == kind}
        step_costs.draw("scaling", kind, lines, os.path.join(options.output, f"scaling_{kind}"))


if __name__ == "__main__":
    main()
