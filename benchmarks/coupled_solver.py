#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the parts of a simultaneous step take in a few scenes: tangents, corrections, iterations, seconds; against another
program, other settings, and time splitting.

usage: benchmarks/coupled_solver.py PROGRAM [--against OTHER_PROGRAM] [--settings Section/Key=value]... [--scenes NAME,NAME]
                                    [--quick] [--steps N] [--repeat N] [--ranks N] [--mpirun COMMAND] [--output FOLDER]
       benchmarks/coupled_solver.py --plot FILE.csv... [--output FOLDER]

All variants of a scene are run in turns, several times, and medians are taken, so that what disturbs the machine disturbs all.
Each of --settings is a variant of each program. Writes coupled_solver.md (tables, also printed), .csv (all numbers, as they
come), .svg and .png (seconds by part) to FOLDER (default: output/coupled_solver). --quick: without the largest scene, two
steps, once.
"""
import argparse
import collections
import os
import re
import tempfile
import textwrap

import step_costs
from study import scene_files
from step_costs import SECONDS, STEP

# A scene: its file, settings, how many times as many steps as others, where these are short, and whether bodies and a fluid are
# solved together in it.
Scene = collections.namedtuple("Scene", "file settings times coupled", defaults=({}, 1, True))
SCENES = {
    "jet_two_sheets": Scene("jet_two_sheets.prm"),
    "jet_two_sheets_fine": Scene("jet_two_sheets.prm", {"Domain/Cells": "96, 48, 48", "Bodies/first/Cells": "1, 20, 12",
                                                        "Bodies/second/Cells": "1, 20, 12"}),
    "jet_two_sheets_2d": Scene("jet_two_sheets_2d.prm", {}, 8),
    "turek_hron_fsi2": Scene("turek_hron_fsi2.prm", {}, 2),
    "balloon": Scene("balloon.prm"),
    "sheet_in_cross_flow": Scene("sheet_in_cross_flow.prm"),
    "closed_chamber": Scene("closed_chamber.prm", {}, 8),
    "hydrostatic_plate": Scene("hydrostatic_plate.prm", {}, 8),
    "cantilever": Scene("cantilever.prm", {}, 1, False),
}
FOLDER = os.path.join(step_costs.ROOT, "prm")
SHORT = 60  # characters of a failure in a table
LARGE = ("jet_two_sheets_fine",)
SPLITTING = "Scheme=time_splitting"
DEFAULT = "default"
PARTS = ("assemble tangent", "solve linear system", "transport")
RUN = ("scene", "program", "settings", "ranks", "steps")
FAILURE = ("failure", "")


def variants(options, scene):
    """[(program, setting)], the default of the first program at the head."""
    programs = [step_costs.Program(path, options.mpirun, options.limit)
                for path in (options.program, options.against) if path]
    if len(programs) > 1 and programs[0].name == programs[1].name:
        programs[1].name += " (other)"
    settings = [DEFAULT, *(each for each in options.settings if scene.coupled or not each.startswith("Coupling/"))]
    if scene.coupled and options.splitting:
        settings.append(SPLITTING)
    return [(program, setting) for setting in settings for program in programs]


def write_scene(scene, path):
    """A copy without the section that only the method of particles reads, which other versions may not know."""
    text = scene_files.without(os.path.join(FOLDER, scene.file), ())
    with open(path, "w") as file:
        file.write(re.sub(r"^subsection Particles\n.*?^end\n", "", text, flags=re.M | re.S))


def measure_scene(options, name):
    """{run: numbers or failure} of all variants of a scene, in turns."""
    scene, results, failures = SCENES[name], collections.defaultdict(list), {}
    steps = options.steps * scene.times
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, scene.file)
        write_scene(scene, file)
        for turn in range(1, options.repeat + 1):
            for program, setting in variants(options, scene):
                run = (name, program.name, setting, str(options.ranks), str(steps))
                if run in failures:
                    continue
                key, _, value = setting.partition("=")
                settings = {"Folder of files": FOLDER, **scene.settings, **({key: value} if setting != DEFAULT else {})}
                try:
                    results[run].append(step_costs.measure(program, file, settings, options.ranks, steps))
                except step_costs.Failure as failure:
                    failures[run] = {FAILURE: str(failure)}
                said = failures[run][FAILURE] if run in failures else f"{results[run][-1][STEP, SECONDS]:.4g} s a step"
                step_costs.say(f"{name}, {program.name}, {setting}, turn {turn}: {said}")
    return {run: failures.get(run) or step_costs.median(several) for run, several in results.items()}


def seconds_of(values, part):
    """Of all phases of that name that lie in no other one of it."""
    found = [(quantity, value) for (quantity, unit), value in values.items() if unit == SECONDS]
    return sum(value for quantity, value in found
               if quantity.split(" / ")[-1] == part and part not in quantity.split(" / ")[:-1])


def ratio(values, reference):
    if FAILURE in values or FAILURE in reference or not reference[STEP, SECONDS]:
        return ""
    return f"{values[STEP, SECONDS] / reference[STEP, SECONDS]:.2f}"


def cells(values):
    """What is said of a run."""
    if FAILURE in values:
        return [textwrap.shorten(values[FAILURE], SHORT, placeholder=" ..."), *[""] * (4 + len(PARTS))]
    counts = [values.get(key) for key in (("tangents", STEP), ("corrections", STEP), ("GMRES iterations", STEP),
                                          ("most iterations of a solve", "1"))]
    return [step_costs.number(values[STEP, SECONDS]), *map(step_costs.number, counts),
            *(step_costs.number(seconds_of(values, part)) for part in PARTS)]


def by_scene(found):
    scenes = {}
    for run, values in found.items():
        scenes.setdefault(run[0], {})[run[1:]] = values
    return scenes


def steps_table(scenes):
    """A row for each variant; its step over that of the first one of the scene."""
    rows = []
    for scene, runs in scenes.items():
        first = next(iter(runs.values()))
        for (program, setting, *_), values in runs.items():
            own = cells(values)
            rows.append([scene, program, setting, own[0], ratio(values, first), *own[1:]])
    return step_costs.table(["scene", "program", "settings", "s a step", "over the first", "tangents", "corrections", "GMRES iterations",
                             "most in a solve", *(f"{part} [s]" for part in PARTS)], rows)


def against_table(scenes):
    """A program over another one with the same settings."""
    programs = list(dict.fromkeys(program for runs in scenes.values() for program, *_ in runs))
    if len(programs) != 2:
        return []
    rows = []
    for scene, runs in scenes.items():
        for (program, setting, *rest), values in runs.items():
            other = runs.get((programs[1], setting, *rest))
            if program == programs[0] and other and ratio(values, other):
                parts = [(seconds_of(values, part), seconds_of(other, part)) for part in PARTS]
                counts = [(values.get(key), other.get(key)) for key in (
                    ("tangents", STEP), ("corrections", STEP), ("GMRES iterations", STEP))]
                rows.append([scene, setting, ratio(values, other),
                             *(f"{own / base:.2f}" if own is not None and base else "" for own, base in parts + counts)])
    return [f"## {programs[0]} over {programs[1]}", ""] + step_costs.table(
        ["scene", "settings", "a step", *PARTS, "tangents", "corrections", "GMRES iterations"], rows)


def splitting_table(scenes):
    """The simultaneous scheme over time splitting."""
    rows, failed = [], []
    for scene, runs in scenes.items():
        for (program, setting, *rest), values in runs.items():
            split = runs.get((program, SPLITTING, *rest))
            if setting == DEFAULT and split and ratio(values, split):
                rows.append([scene, program, step_costs.number(values[STEP, SECONDS]), step_costs.number(split[STEP, SECONDS]),
                             ratio(values, split)])
            elif setting == DEFAULT and split:
                failed.append(scene)
    lines = ["## Simultaneous over time splitting", ""] + step_costs.table(
        ["scene", "program", "simultaneous [s a step]", "time splitting [s a step]", "ratio"], rows) if rows else []
    return lines + ([f"Without a result by one of them: {', '.join(dict.fromkeys(failed))}.", ""] if failed else [])


def failures_of(scenes):
    lines = [f"- {scene}, {program}, {setting}: {values[FAILURE]}" for scene, runs in scenes.items()
             for (program, setting, *_), values in runs.items() if FAILURE in values]
    return ["## Runs without a result", "", *lines, ""] if lines else []


def report(scenes):
    lines = ["# The parts of a simultaneous step", "",
             f"Of a step, without the first {step_costs.FIRST}: wall seconds, and how many tangents, corrections of Newton's method and "
             "iterations of GMRES there are; the most iterations of one solve. An integrator of two stages solves twice in a step.", ""]
    return "\n".join([*lines, *steps_table(scenes), *against_table(scenes), *splitting_table(scenes),
                      *failures_of(scenes)])


def bars(scenes):
    """{scene: {variant: {part: seconds}}}, parts that have the same name in several schemes as one."""
    result = {}
    several = len({program for runs in scenes.values() for program, *_ in runs}) > 1
    for scene, runs in scenes.items():
        for (program, setting, *_), values in runs.items():
            if FAILURE in values:
                continue
            parts = collections.Counter()
            for name, seconds in step_costs.parts({name: value for (name, unit), value in values.items()
                                                   if unit == SECONDS}).items():
                parts[name.split(" / ")[-1]] += seconds
            result.setdefault(scene, {})[f"{program}\n{setting}" if several else setting] = parts
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?")
    parser.add_argument("--against", metavar="OTHER_PROGRAM")
    parser.add_argument("--settings", action="append", default=[], metavar="Section/Key=value")
    parser.add_argument("--scenes", default="", help=f"of {', '.join(SCENES)}; default: all")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--no-splitting", dest="splitting", action="store_false")
    parser.add_argument("--steps", type=int, help="that count, after the first two (default: 5)")
    parser.add_argument("--repeat", type=int, help="medians of so many measurements (default: 3)")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--mpirun", default="mpirun", help="with its options, '-n RANKS' is added")
    parser.add_argument("--limit", type=float, default=0, help="of a run [s]; 0: none")
    parser.add_argument("--output", metavar="FOLDER", default=os.path.join("output", "coupled_solver"))
    parser.add_argument("--plot", nargs="+", metavar="FILE.csv", help="of earlier runs: tables and a plot from them")
    options = parser.parse_args()
    options.steps = options.steps or (2 if options.quick else 5)
    options.repeat = options.repeat or (1 if options.quick else 3)
    names = options.scenes.split(",") if options.scenes else [
        name for name in SCENES if not (options.quick and name in LARGE)]
    unknown = [name for name in names if name not in SCENES]
    if bool(options.program) == bool(options.plot) or unknown:
        parser.error(f"no scenes: {', '.join(unknown)}" if unknown else "either a program or --plot")
    os.makedirs(options.output, exist_ok=True)
    path = os.path.join(options.output, "coupled_solver")
    if options.program:
        listing, options.plot = step_costs.Listing(path + ".csv", RUN), [path + ".csv"]
        for name in names:
            for run, values in measure_scene(options, name).items():
                listing.add(run, values)
        listing.close()
    scenes = by_scene(step_costs.read_listing(options.plot))
    step_costs.write_report(report(scenes), path + ".md")
    step_costs.draw("stacked_bars", bars(scenes), path)


if __name__ == "__main__":
    main()
