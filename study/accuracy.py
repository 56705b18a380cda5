# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a scene with the cheapest settings for an error that is asked for.

usage: ./undine SCENE.prm --accuracy 1% [--of "tip displacement x"] [--as "over time"] [--within 20min] [--output DIR]
                          [--set Section/Key=value]... [--overwrite]

Coarse runs, in each of which one thing is coarser than in the others, tell which part of the error comes from what; the
settings for the error asked for follow, and coarser neighbours of that run check it.
"""
import argparse
import math
import os
import sys
import tempfile
import time

from study import error_model, knobs
from study.__main__ import duration
from study.campaign import readable
from study.description import Study
from study.pilot import COARSER, NoCoarserRun, Pilot, Refused, Setting, estimate, quantity_of
from study.tables import percent, table

FIRST = 0.25  # factor of the first settings, of those of the scene
AIM = 0.85  # of the error asked for: the parts are estimates
LARGEST_JUMP, CAREFUL_JUMP = 10.0, 8.0  # of cost, from one setting to the next
ROUNDS = 8
KNOWN = 0.3  # a greater error says nothing about smaller ones
MEASURES = ("over time", "end", "mean", "largest", "smallest", "middle", "amplitude", "frequency", "period")


def least_factors(found):
    """No coarser than the runs that have told something, with room for coarser neighbours, and as a run with outputs can
    be."""
    return [max(with_room(knob), knob.least_with_outputs(), part.factor / COARSER)
            for knob, part in zip(found.setting.knobs, found.parts)]


def next_setting(found, wanted):
    """The cheapest setting for the error, no dearer than the largest jump, or a smaller one where values do not come closer
    yet."""
    factors = error_model.cheapest(found.parts, wanted, least_factors(found))
    ratio = error_model.cost_ratio(found.parts, factors)
    jump = CAREFUL_JUMP if found.remarks or found.total() > KNOWN else LARGEST_JUMP
    if ratio > jump:
        share = math.log(jump) / math.log(ratio)
        factors = [max(part.factor * (factor / part.factor) ** share, knob.least_with_outputs())
                   for part, factor, knob in zip(found.parts, factors, found.setting.knobs)]
    return Setting(found.setting.knobs, tuple(knobs.snapped(knob, factor) for knob, factor in
                                              zip(found.setting.knobs, factors)))


def with_room(knob):
    """The least factor of which there are coarser ones."""
    return min(1.0, COARSER * knob.coarsest())


def first_estimate(pilot, all_knobs):
    """Of settings a quarter as fine as the scene, or as fine as needed for the run and its coarser neighbours to succeed."""
    factor, reason = FIRST, None
    while factor <= 2:
        setting = Setting(all_knobs, tuple(knobs.snapped(knob, max(factor, with_room(knob))) for knob in all_knobs))
        if pilot.run(setting) is not None:
            try:
                return estimate(pilot, setting, None, 2)
            except NoCoarserRun as missing:
                reason = str(missing)
        else:
            reason = "the scene's own settings fail: " + pilot.failures[setting]
        factor *= 2
    raise Refused(reason)


def expected_cost(pilot, found, factors):
    """Core seconds."""
    return pilot.costs[found.setting] * error_model.cost_ratio(found.parts, factors)


def refuse_what_takes_too_long(pilot, history, setting, wanted):
    """Where the next run does not fit into the time, or, once values come closer, the last one."""
    if not pilot.deadline:
        return
    left, found = pilot.deadline - time.monotonic(), history[-1]
    whole = expected_cost(pilot, found, error_model.cheapest(found.parts, wanted * AIM, least_factors(found)))
    is_sure = len(history) > 1 and not found.remarks and found.total() < KNOWN
    if expected_cost(pilot, found, setting.factors) > left or (is_sure and whole > left):
        raise Refused(f"it would take about {readable(whole)}, but {readable(max(left, 0))} of the time allowed are left; so "
                      f"far the error is about {percent(found.total())}")


def refuse_what_does_not_converge(history):
    """Three settings, each finer than the one before, without a smaller error: a chaotic flow, for example."""
    finer = len(history) >= 3 and all(
        late >= early for coarse, fine in ((history[-3], history[-2]), (history[-2], history[-1]))
        for early, late in zip(coarse.setting.factors, fine.setting.factors))
    if finer and history[-1].total() > 0.8 * history[-3].total():
        errors = ", ".join(percent(each.total()) for each in history[-3:])
        raise Refused(f"runs do not come closer to each other as they are refined: the estimates are {errors}. Flows that "
                      "are chaotic have no accurate values over time: ask for a mean with --as mean, or for a shorter time")


def say(found):
    """Where a setting stands."""
    parts = ", ".join(f"{knob.name} {percent(part.size)} (order {part.order:.1f})"
                      for knob, part in zip(found.setting.knobs, found.parts))
    print(f"error about {percent(found.total())}: {parts}", file=sys.stderr, flush=True)


def search(pilot, all_knobs, wanted, run_with_outputs):
    """Estimates of all settings tried; the last one is accurate enough, and its run is the one that the user gets."""
    history = [first_estimate(pilot, all_knobs)]
    say(history[0])
    while True:
        found = history[-1]
        setting = next_setting(found, AIM * wanted)
        refuse_what_takes_too_long(pilot, history, setting, wanted)
        if run_with_outputs(setting) is None:
            raise Refused(f"the run with {setting.name(pilot.study)} fails: {pilot.failures[setting]}")
        history.append(estimate(pilot, setting, found.parts, 1))
        say(history[-1])
        if history[-1].total() <= wanted:
            return history
        if len(history) > ROUNDS:
            raise Refused(f"after {ROUNDS} refinements the error is still about {percent(found.total())}")
        refuse_what_does_not_converge(history)


def report(pilot, history, wanted):
    """What the user is told at the end."""
    found = history[-1]
    others = sum(cost for setting, cost in pilot.costs.items() if setting != found.setting)
    half = error_model.cheapest(found.parts, found.total() / 2, found.setting.factors)
    rows = [[knob.name, "; ".join(knob.settings(factor).values()), percent(part.size), f"{part.order:.1f}"]
            for knob, factor, part in zip(found.setting.knobs, found.setting.factors, found.parts)]
    lines = ["", f"error of '{pilot.quantity.name}' ({pilot.quantity.evaluate}): about {percent(found.total())}, "
             f"{percent(wanted)} were asked for; the truth may be a factor of two and more away from an estimate",
             *table(["what", "value", "part of the error", "order"], rows)]
    lines += [f"note: {remark}" for remark in found.remarks]
    lines += [f"note: '{key}' has a single cell along an axis in all runs: what that does to the error is not known"
              for knob, factor in zip(found.setting.knobs, found.setting.factors) for key in knob.single_cells(factor)]
    lines += [f"this run: {pilot.costs[found.setting]:.3g} core s; {len(pilot.costs) - 1} others before: {others:.3g} core s",
              f"half of the error would take about "
              f"{expected_cost(pilot, found, half):.3g} core s"]
    return "\n".join(lines)


def default_column(columns):
    """A displacement of a probe, else what a probe measures, else a force, else the fluid's kinetic energy."""
    for word in (" displacement ", " velocity ", " front", "pressure force ", "inetic energy"):
        for name, values in columns.items():
            if word in name and abs(values).max() > 0:
                return name
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
    parser.add_argument("--of", metavar="COLUMN", help="of the file 'statistics'")
    parser.add_argument("--as", dest="measure", choices=MEASURES, default="over time", help="what of the column is accurate")
    parser.add_argument("--within", type=duration, metavar="TIME", help="refuse what would take longer, such as 20min")
    parser.add_argument("--output", metavar="DIR")
    parser.add_argument("--overwrite", action="store_true")
    parser.add_argument("--set", dest="assignments", action="append", default=[], metavar="Section/Key=value")
    parser.add_argument("--program", default=os.environ.get("UNDINE_PROGRAM", "build/undine"), help=argparse.SUPPRESS)
    return parser.parse_args(words)


def main(words):
    options = arguments(words)
    found = knobs.parameters(options.program, options.scene, options.assignments)
    settings = dict(assignment.split("=", 1) for assignment in options.assignments)
    if float(found.get("Time/Tolerance", 0)) > 0:
        print("note: 'Time/Tolerance' is left out of account: the step is chosen for the error", file=sys.stderr)
        settings["Time/Tolerance"] = "0"
    study = Study("", options.scene, os.path.abspath(options.scene), 1, 0.0, 0.0, "core seconds", "all", [], settings, [])
    all_knobs = tuple(knobs.knobs_of(found))
    deadline = time.monotonic() + options.within if options.within else None
    output = options.output or found["Output/Directory"]
    with tempfile.TemporaryDirectory() as folder:
        pilot = Pilot(options.program, study, lambda columns: quantity_of(options.of or default_column(columns),
                                                                          options.measure), folder, deadline)
        tries = []

        def run_with_outputs(setting):
            tries.append(setting)
            return pilot.run_with_outputs(setting, [options.program, options.scene, "--output", output] + [
                "--overwrite"] * (options.overwrite or len(tries) > 1), output)

        try:
            history = search(pilot, all_knobs, options.accuracy, run_with_outputs)
        except Refused as reason:
            left = f" What is in '{output}' is less accurate." if tries else ""
            sys.exit(f"\nError: an error of {percent(options.accuracy)} was not reached: {reason}.{left}")
        except KeyboardInterrupt:
            print(f"\nstopped; './undine resume {output}' goes on with the run that was under way" if tries else
                  "\nstopped before the run", file=sys.stderr)
            sys.exit(130)
        print(report(pilot, history, options.accuracy))
        print(f"results: {output}")


if __name__ == "__main__":
    main(sys.argv[1:])
