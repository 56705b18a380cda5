# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a scene with the cheapest settings for an error that is asked for.

usage: ./undine SCENE.prm --accuracy 1% [--of "tip displacement x"] [--as "over time"] [--within 20min] [--output DIR]
                          [--set Section/Key=value]... [--overwrite]

Coarse runs, in each of which one thing is coarser than in the others, tell which part of the error comes from what; the
settings for the error asked for follow, and whether their run changes the values as was foretold checks it.
"""
import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

from study import earlier, knobs
from study.campaign import readable
from study.description import Study
from study.duration import duration
from study.pilot import Destination, Pilot, Refused, quantity_of
from study.search import Search
from study.tables import percent, table

MEASURES = ("over time", "end", "mean", "largest", "smallest", "middle", "amplitude", "frequency", "period")


def report(search):
    """What the user is told at the end."""
    pilot, setting, level = search.pilot, search.setting, search.levels[-1]
    parts = list(zip(setting.knobs, setting.factors))
    (own, own_wall), (others, wall), count = pilot.spent(setting)
    rows = [[knob.name, "; ".join(knob.settings(factor).values()), percent(size),
             f"{part.order:.1f}" + ("" if part.seen is not None else " (assumed)")]
            for (knob, factor), size, part in zip(parts, search.parts(), level.model.parts)]
    expected = search.expected_error()
    cancels = f" ({percent(expected)} if parts cancel each other as they seem to)" if expected < 0.8 * search.error else ""
    half, is_enough = search.cost_of_half()
    half += own - pilot.costs[setting]  # its outputs
    lines = ["", f"error of '{pilot.quantity.name}' ({pilot.quantity.evaluate}): about {percent(search.error)}{cancels}, "
             f"{percent(search.wanted)} were asked for; the truth may be a factor of two and more away from an estimate",
             *table(["what", "value", "part of the error", "order"], rows)]
    lines += [f"note: {remark}" for remark in level.remarks + level.cautions]
    lines += [f"note: '{key}' has a single cell along an axis in all runs: what that does to the error is not known"
              for knob, factor in parts for key in knob.single_cells(factor)]
    lines += [f"this run: {own:.3g} core s; {count} others before: {others:.3g} core s; with their starts they have taken "
              f"{readable(own_wall)} and {readable(wall)}",
              f"half of the error would take {'about' if is_enough else 'more than'} {half:.3g} core s"]
    return "\n".join(lines)


def default_column(columns):
    """The displacement of a probe, else what a probe measures, else a force, with all components that these have, else the
    fluid's kinetic energy."""
    for word in (" displacement ", " velocity ", " front", "pressure force ", "inetic energy"):
        for name in columns:
            vector = re.sub(" [xyz]$", "", name)
            components = [values for other, values in columns.items() if re.sub(" [xyz]$", "", other) == vector]
            if word in f" {name}" and max(abs(values).max() for values in components) > 0:
                return vector
    raise Refused("name a column of 'statistics' with --of")


def share(text):
    """0.01 of "1%" or "0.01"."""
    value = float(text.rstrip("% ")) / (100 if "%" in text else 1)
    if not 0 < value < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is no relative error; examples: 5%, 0.01")
    return value


def arguments(words):
    parser = argparse.ArgumentParser(prog="./undine", description=__doc__.split("\n\n")[2])
    parser.add_argument("scene", metavar="SCENE.prm")
    parser.add_argument("--accuracy", type=share, required=True, metavar="ERROR", help="relative, such as 1%%")
    parser.add_argument("--of", metavar="COLUMN", help="of the file 'statistics', or a vector whose components are columns")
    parser.add_argument("--as", dest="measure", choices=MEASURES, default="over time", help="what of the column is accurate")
    parser.add_argument("--within", type=duration, metavar="TIME", help="refuse what would take longer, such as 20min")
    parser.add_argument("--output", metavar="DIR")
    parser.add_argument("--overwrite", action="store_true")
    parser.add_argument("--set", dest="assignments", action="append", default=[], metavar="Section/Key=value")
    parser.add_argument("--program", default=os.environ.get("UNDINE_PROGRAM", "build/undine"), help=argparse.SUPPRESS)
    return parser.parse_args(words)


def refuse_folder(folder):
    """Before anything is run for it: a run that has not come to its end is not replaced unless that is asked for."""
    try:
        with open(os.path.join(folder, "summary.json")) as file:
            has_ended = json.load(file).get("ended")
    except (OSError, ValueError):
        has_ended = False
    if os.path.exists(os.path.join(folder, "checkpoint")) and not has_ended:
        sys.exit(f"Error: '{folder}' holds a run that has not reached its end. It can go on by './undine resume {folder}'. To begin "
                 "anew, choose another folder with --output, or replace that run with --overwrite")


def main(words):
    options = arguments(words)
    found = knobs.parameters(options.program, options.scene, options.assignments)
    settings = dict(map(str.strip, assignment.split("=", 1)) for assignment in options.assignments)
    if float(found.get("Time/Tolerance", 0)) > 0:
        print("note: 'Time/Tolerance' is left out of account: the step is chosen for the error", file=sys.stderr)
        settings["Time/Tolerance"] = "0"
        found = {**found, "Time/Tolerance": "0"}  # of earlier runs only those whose step was given, too
    # Coarse runs write nothing: they would have to land on the times of outputs.
    written = {key: settings.pop(key) for key in ("Output/Interval", "Output/Parts") if key in settings}
    study = Study("", options.scene, os.path.abspath(options.scene), 1, 0.0, 0.0, "core seconds", "all", [], settings, [])
    all_knobs = tuple(knobs.knobs_of(found))
    if not all_knobs:
        sys.exit("Error: nothing of this scene can be refined: no time passes, and its elements come from files of meshes")
    deadline = time.monotonic() + options.within if options.within else None
    output = options.output or found["Output/Directory"]
    if not options.overwrite:
        refuse_folder(output)
    with tempfile.TemporaryDirectory() as folder:
        pilot = Pilot(options.program, study, lambda columns: quantity_of(options.of or default_column(columns),
                                                                          options.measure, columns), folder, deadline,
                      Destination(output, written, options.overwrite), len(os.sched_getaffinity(0)))
        known = earlier.load(pilot, all_knobs, found, same_probes=not options.of)
        if known:
            print(f"{known} runs of earlier studies of this scene in '{earlier.FOLDER}' are used", file=sys.stderr)
        try:
            search = Search(pilot, all_knobs, options.accuracy)
            search.run()
        except Refused as reason:
            left = f" What is in '{output}' is less accurate." if pilot.has_outputs else ""
            sys.exit(f"\nError: an error of {percent(options.accuracy)} was not reached: {reason}.{left}")
        except KeyboardInterrupt:
            said = (f"'./undine resume {output}' goes on with the run that was under way" if pilot.under_way else
                    f"what is in '{output}' is less accurate" if pilot.has_outputs else "there is no result yet")
            print(f"\nstopped; {said}", file=sys.stderr, flush=True)
            shutil.rmtree(folder, ignore_errors=True)
            os._exit(130)  # without waiting for coarse runs, which end with this program
        print(report(search))
        print(f"results: {output}")
        if found.get("Output/Report") == "true" and os.environ.get("UNDINE_REPORT") != "off":
            subprocess.run([sys.executable, "-m", "report", output], check=False)  # runs of the search write none


if __name__ == "__main__":
    main(sys.argv[1:])
