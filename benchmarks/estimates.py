#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How true the estimates of `--accuracy` are: the error that it promises against that by finer runs, and its cost
against that of the best settings found by trying them all.

usage: benchmarks/estimates.py [PROGRAM] [--case bar]... [--accuracy 5%]... [--best]

Five scenes (benchmarks/estimates), 5 and 1 %. Truth: runs 1.4 times and twice as fine in everything, extrapolated. --best:
also try all settings between half and twice as fine in each thing that cost no more. One core; a quarter of an hour, with
--best an hour.
"""
import argparse
import itertools
import math
import os
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, ROOT)
from study import convergence, knobs, runs  # noqa: E402
from study.accuracy import share  # noqa: E402
from study.description import Study  # noqa: E402
from study.pilot import Pilot, Refused, Setting, quantity_of  # noqa: E402
from study.search import Search  # noqa: E402
from study.tables import percent  # noqa: E402

CASES = {"bar": "tip displacement y", "panel": "corner displacement x", "disc": "behind velocity x",
         "sheet": "tip displacement x", "column": "Kinetic energy of fluid"}
TRIED = [2 ** (k / 2) for k in (-2, -1, 0, 1, 2)]  # factors around those of the run


def scaled(setting, ratios):
    """Finer by a ratio in each thing."""
    return Setting(setting.knobs, tuple(knob.nearest(max(ratio * factor, knob.coarsest()))
                                        for knob, ratio, factor in zip(setting.knobs, ratios, setting.factors)))


def errors(pilot, settings, truth, times):
    """Relative, of settings that have values."""
    scale = convergence.norm(truth)
    return {setting: convergence.norm(pilot.values[setting].at(times) - truth) / scale for setting in settings
            if setting in pilot.values}


def limit(pilot, setting):
    """What runs lead to that are finer in everything, up to twice, and the times of its values; None if one of them fails.
    The lengths are the mean of those of all things, as whole numbers of cells make them."""
    chain = [scaled(setting, [2 ** (k / 2)] * len(setting.knobs)) for k in range(3)]
    if any(pilot.run(each) is None for each in chain):
        return None, None
    times = min((pilot.values[each].times for each in chain), key=len)
    lengths = [1 / (sum(a / b for a, b in zip(each.factors, setting.factors)) / len(each.factors)) for each in chain]
    return convergence.limit(lengths, [pilot.values[each].at(times) for each in chain]), times


def best_cost(pilot, setting, wanted, truth, times):
    """Of the cheapest settings that are as accurate as asked for, as are all finer ones, so that nothing is owed to errors that
    cancel, among those that should cost no more than the run."""
    growths = [knob.growth for knob in setting.knobs]
    for factors in itertools.product(TRIED, repeat=len(growths)):
        if math.prod(factor ** growth for factor, growth in zip(factors, growths)) <= 1:
            pilot.run(scaled(setting, factors))
    found = errors(pilot, pilot.values, truth, times)
    accurate = [each for each in found if all(
        error <= wanted for other, error in found.items()
        if all(fine >= coarse for fine, coarse in zip(other.factors, each.factors)))]
    return min((pilot.costs[each] for each in accurate), default=float("nan"))


def row(program, name, wanted, with_best):
    scene = os.path.join(ROOT, "benchmarks", "estimates", f"{name}.prm")
    study = Study("", scene, scene, 1, 0.0, 0.0, "core seconds", "all", [], {}, [])
    with tempfile.TemporaryDirectory() as folder:
        pilot = Pilot(program, study, lambda _: quantity_of(CASES[name], "over time"), folder, None)
        search = Search(pilot, tuple(knobs.knobs_of(knobs.parameters(program, scene, []))), wanted, pilot.run)
        try:
            search.run()
        except Refused as reason:
            return f"| {name} | {percent(wanted)} | refused: {reason} |"
        setting, cost = search.setting, pilot.costs[search.setting]
        others, _ = pilot.cost_of_others(setting)
        true, times = limit(pilot, setting)
        if true is None:
            return f"| {name} | {percent(wanted)} | no truth: {list(pilot.failures.values())[-1]} |"
        error = errors(pilot, [setting], true.value, times)[setting]
        sure = true.uncertainty / convergence.norm(true.value)
        best = best_cost(pilot, setting, wanted, true.value, times) if with_best else float("nan")
    settings = "; ".join(f"{value}" for knob, factor in zip(setting.knobs, setting.factors)
                         for value in knob.settings(factor).values())
    return (f"| {name} | {percent(wanted)} | {settings} | {percent(search.error)} | {percent(search.expected_error())} | {percent(error)} ± {percent(sure)} | "
            f"{error / wanted:.2f} | {search.expected_error() / error:.2f} | {cost:.3g} | {others:.3g} | {best:.3g} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--case", action="append", choices=CASES)
    parser.add_argument("--accuracy", action="append", type=share)
    parser.add_argument("--best", action="store_true")
    options = parser.parse_args()
    os.environ.update(runs.environment())
    print("| scene | asked for | settings | estimated | with what cancels | true | true / asked for | with what cancels / true | run [core s] | "
          "other runs [core s] | best settings [core s] |\n" + 11 * "|---" + "|", flush=True)
    for name in options.case or CASES:
        for wanted in options.accuracy or (0.05, 0.01):
            print(row(options.program, name, wanted, options.best), flush=True)


if __name__ == "__main__":
    main()
