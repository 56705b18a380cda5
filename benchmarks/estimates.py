#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How true the estimates of `--accuracy` are: the error that it promises against that by finer runs, and its cost
against that of the best settings found by trying them all.

usage: benchmarks/estimates.py [PROGRAM] [--case bar]... [--accuracy 5%]... [--best]

Five scenes (benchmarks/estimates), 5 and 1 %, by the way that users take. Truth: the most accurate of these runs, and runs
1.4 times and twice as fine in everything, extrapolated. --best: also try all settings between half and twice as fine in each
thing that cost no more. Costs are those without the start of the program and without outputs. One core; a quarter of an hour,
with --best an hour.
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
from study.pilot import Destination, Pilot, Refused, Setting, quantity_of  # noqa: E402
from study.quantities import Values  # noqa: E402
from study.search import Search  # noqa: E402
from study.tables import percent  # noqa: E402

CASES = {"bar": "tip displacement y", "panel": "corner displacement x", "disc": "behind velocity x",
         "sheet": "tip displacement x", "column": "Kinetic energy of fluid"}
TRIED = [2 ** (k / 2) for k in (-2, -1, 0, 1, 2)]  # factors around those of the run


def scaled(setting, ratios):
    """Finer by a ratio in each thing."""
    return Setting(setting.knobs, tuple(knob.nearest(max(ratio * factor, knob.coarsest()))
                                        for knob, ratio, factor in zip(setting.knobs, ratios, setting.factors)))


def relative_error(found, truth):
    """Of values, at those of their times that the truth has, too, which was computed with finer steps."""
    times = found.times[(found.times >= truth.times[0]) & (found.times <= truth.times[-1])]
    exact = truth.at(times)
    return convergence.norm(found.at(times) - exact) / convergence.norm(exact)


def limit(pilot, setting):
    """What runs lead to that are finer in everything, up to twice, and its relative uncertainty; None if one of them fails.
    The lengths are the mean of those of all things, as whole numbers of cells make them."""
    chain = [scaled(setting, [2 ** (k / 2)] * len(setting.knobs)) for k in range(3)]
    if any(pilot.run(each) is None for each in chain):
        return None, math.nan
    times = min((pilot.values[each].times for each in chain), key=len)
    lengths = [1 / (sum(a / b for a, b in zip(each.factors, setting.factors)) / len(each.factors)) for each in chain]
    found = convergence.limit(lengths, [pilot.values[each].at(times) for each in chain])
    return Values(times, found.value), found.uncertainty / convergence.norm(found.value)


def best_cost(pilot, setting, wanted, truth, sure):
    """Of the cheapest settings that are as accurate as asked for, as are all finer ones, so that nothing is owed to errors that
    cancel, among those that should cost no more than the run; whatever the truth is, as far as it is known."""
    growths = [knob.growth for knob in setting.knobs]
    for factors in itertools.product(TRIED, repeat=len(growths)):
        if math.prod(factor ** growth for factor, growth in zip(factors, growths)) <= 1:
            pilot.run(scaled(setting, factors))
    found = {each: relative_error(values, truth) for each, values in pilot.values.items()}
    accurate = [each for each in found if all(
        error + sure <= wanted for other, error in found.items()
        if all(fine >= coarse for fine, coarse in zip(other.factors, each.factors)))]
    return min((pilot.costs[each] for each in accurate), default=float("nan"))


def search_for(program, name, wanted, folder):
    """The settings that are found for an error, by a pilot of their own; Refused."""
    scene = os.path.join(ROOT, "benchmarks", "estimates", f"{name}.prm")
    study = Study("", scene, scene, 1, 0.0, 0.0, "core seconds", "all", [], {}, [])
    os.makedirs(folder)
    pilot = Pilot(program, study, lambda _: quantity_of(CASES[name], "over time"), folder, None,
                  Destination(os.path.join(folder, "results"), {}, True))
    search = Search(pilot, tuple(knobs.knobs_of(knobs.parameters(program, scene, []))), wanted)
    search.run()
    return search


def row(search, spent, truth, sure, with_best):
    pilot, setting, wanted = search.pilot, search.setting, search.wanted
    cost, (_, (others, _), count) = pilot.costs[setting], spent
    error = relative_error(pilot.values[setting], truth)
    best = best_cost(pilot, setting, wanted, truth, sure) if with_best else float("nan")
    settings = "; ".join(f"{value}" for knob, factor in zip(setting.knobs, setting.factors)
                         for value in knob.settings(factor).values())
    return (f"{settings} | {percent(search.error)} | {percent(search.expected_error())} | {percent(error)} ± {percent(sure)} | "
            f"{error / wanted:.2f} | {search.expected_error() / error:.2f} | {cost:.3g} | {others:.3g} ({count}) | {best:.3g}")


def rows(program, name, errors_wanted, with_best):
    """Of one scene, whose truth is that next to the most accurate of its runs."""
    with tempfile.TemporaryDirectory() as folder:
        found, spent, texts = {}, {}, {}
        for wanted in errors_wanted:
            try:
                found[wanted] = search_for(program, name, wanted, os.path.join(folder, f"{wanted}"))
                spent[wanted] = found[wanted].pilot.spent(found[wanted].setting)  # before there are runs for the truth
            except Refused as reason:
                texts[wanted] = f"refused: {reason}"
        if found:
            finest = found[min(found)]
            truth, sure = limit(finest.pilot, finest.setting)
            missing = "" if truth else f"no truth: {list(finest.pilot.failures.values())[-1]}"
            texts.update({wanted: missing or row(search, spent[wanted], truth, sure, with_best) for wanted, search in found.items()})
    return [f"| {name} | {percent(wanted)} | {texts[wanted]} |" for wanted in errors_wanted]


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
        print("\n".join(rows(options.program, name, options.accuracy or (0.05, 0.01), options.best)), flush=True)


if __name__ == "__main__":
    main()
