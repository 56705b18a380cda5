# SPDX-License-Identifier: LGPL-2.1-or-later
"""Coarse runs of a scene, which tell what part of its error comes from what."""
import math
import os
import sys
import time
from dataclasses import dataclass, field, replace

from study import convergence, error_model, knobs, quantities, runs
from study.columns import NotEvaluated, read
from study.description import Quantity

COARSER = 2.0  # neighbours, in one thing
SMALLEST_ORDER = 0.7
UNSEEN_ORDER = 1.5  # assumed of coarse runs, for the size of an error
APART = 1.5  # factor between two settings that can tell an order


class Refused(Exception):
    """Why there is no run of that accuracy."""


class NoCoarserRun(Refused):
    """Nothing can be told of a setting, since what is coarser fails."""


@dataclass(frozen=True)
class Setting:
    """Factors of refinement of all knobs; what `runs` needs of a case."""
    knobs: tuple = field(compare=False)
    factors: tuple

    def settings(self, study):
        result = dict(study.settings)
        for knob, factor in zip(self.knobs, self.factors):
            result.update(knob.settings(factor))
        return result

    def name(self, _):
        return ", ".join(f"{key} {value}" for knob, factor in zip(self.knobs, self.factors)
                         for key, value in knob.settings(factor).items())

    def with_factor(self, k, factor):
        return Setting(self.knobs, self.factors[:k] + (factor,) + self.factors[k + 1:])


@dataclass
class Estimate:
    """Of the error of a setting: its parts, and whether what they are made of is sure."""
    setting: Setting
    parts: list
    remarks: list = field(default_factory=list)

    def total(self):
        return sum(part.size for part in self.parts)


def quantity_of(name, measure):
    """The quantity to be accurate: one column."""
    texts = dict.fromkeys(("unit", "period_of", "field", "body", "reference_file", "reference_column", "reference_times"), "")
    return Quantity(name=name, columns=[name], factor=1.0, evaluate=measure, share_of_step=1.0, start=0.0, until=0.0,
                    periods=0, lower=[], upper=[], n_points=[], reference=[], reference_row={}, reference_factor=1.0,
                    scale=0.0, **texts)


class Pilot:
    """Makes runs of a scene and remembers what they gave. Folders of coarse runs are in `folder`. `choose`: the quantity
    that is to be accurate, by the columns of the first run."""

    def __init__(self, program, study, choose, folder, deadline):
        self.program, self.study, self.choose, self.quantity = program, study, choose, None
        self.folder, self.deadline = folder, deadline
        self.values, self.costs, self.failures = {}, {}, {}

    def limit(self):
        """Seconds that a run may take; 0: as many as it likes."""
        return max(1.0, self.deadline - time.monotonic()) if self.deadline else 0

    def run(self, setting):
        """Values of the quantity with a setting; None if the run has failed."""
        if setting not in self.costs:
            folder = os.path.join(self.folder, f"{len(self.costs)}")
            self.take(setting, runs.once(self.program, self.study, setting, folder, self.limit()),
                      os.path.join(folder, "run"))
        return self.values.get(setting)

    def run_with_outputs(self, setting, words, folder):
        """The same with all outputs that the scene asks for, in the user's folder; None if the run has failed."""
        words = words + runs.assignments(setting.settings(self.study))
        with open(os.path.join(self.folder, "printed"), "w+") as printed:
            result = runs.execute(words, self.limit(), printed)
        self.take(setting, {**result, **runs.summary_of(os.path.join(folder, "summary.json"))}, folder)
        return self.values.get(setting)

    def take(self, setting, result, folder):
        """Note what a run in a folder has given."""
        if result["stopped"]:
            raise Refused("the time allowed is over")
        self.costs[setting] = result["core seconds"]
        said = result["failure"]
        print(f"  {setting.name(self.study)}: {said or format(result['core seconds'], '.3g') + ' core s'}", file=sys.stderr,
              flush=True)
        if said:
            self.failures[setting] = said
            return
        try:
            columns = read(os.path.join(folder, "statistics"))
            self.quantity = self.quantity or self.choose(columns)
            self.values[setting] = quantities.evaluate(self.quantity, columns)
        except NotEvaluated as reason:
            raise Refused(str(reason)) from reason

    def compare(self, settings):
        """Values of several settings at common times, [setting][time][component]."""
        found = [self.values[setting] for setting in settings]
        if self.quantity.evaluate != "over time":
            return [each.values for each in found]
        times = min((each.times for each in found), key=len)
        return [each.at(times) for each in found]


def observed_part(pilot, setting, k, coarser):
    """Part of the error that one knob has, from values with it ever coarser; and a remark."""
    knob = setting.knobs[k]
    chain = [setting] + [each for each in coarser if each in pilot.values]
    if len(chain) < 2:
        return None, f"{knob.name}: no coarser run has succeeded"
    values = pilot.compare(chain)
    scale = convergence.norm(values[0])
    if scale == 0:
        raise Refused("the quantity is zero all the time: choose another one with --of")
    factors = [each.factors[k] for each in chain]
    difference = convergence.norm(values[0] - values[1]) / scale
    order, order_of_size, remark = knob.order, min(knob.order, UNSEEN_ORDER), ""
    if len(chain) > 2 and difference > 0:
        seen = convergence.observed_order([1 / factor for factor in factors[::-1]], values[::-1])
        if math.isnan(seen):  # a size that is no less than it may be, but no hope that it falls as slowly for ever
            order_of_size, remark = SMALLEST_ORDER, f"{knob.name}: values do not come closer yet"
            difference = max(difference, convergence.norm(values[1] - values[2]) / scale)
        else:
            order = order_of_size = sensible(seen, knob)
    return error_model.Part(difference, factors[0] / factors[1], factors[0], order_of_size, order, knob.growth), remark


def coarser_neighbours(setting, k, count):
    """With one knob coarser by two, by four, ..., as far as that is sensible and differs."""
    knob, found = setting.knobs[k], []
    for n in range(1, count + 1):
        factor = knobs.snapped(knob, setting.factors[k] / COARSER ** n)
        if factor < 0.8 * (found[-1] if found else setting).factors[k]:
            found.append(setting.with_factor(k, factor))
    return found


def sensible(order, knob):
    """One greater than expected is chance, or an error that will not fall as fast for long."""
    return min(max(order, SMALLEST_ORDER), knob.order)


def with_order_between(part, before, knob):
    """A part with the order that follows from the differences at two settings, if these are far enough from each other to
    tell one; else with that of the earlier one."""
    order, order_of_size = before.order, before.order_of_size
    if before.difference > 0 and part.difference > 0 and part.factor > APART * before.factor:
        seen = math.log(before.difference / part.difference) / math.log(part.factor / before.factor)
        order = order_of_size = sensible(seen, knob)
    return replace(part, order=order, order_of_size=order_of_size)


def estimate(pilot, setting, known, count):
    """The parts of a setting's error. `known`: parts from an earlier setting, which tell the order where `count` coarser
    neighbours are too few for that."""
    parts, remarks = [], []
    for k, knob in enumerate(setting.knobs):
        neighbours = coarser_neighbours(setting, k, count)
        for each in neighbours:
            pilot.run(each)
        part, remark = observed_part(pilot, setting, k, neighbours)
        if part is None:
            raise NoCoarserRun(remark)
        if len(neighbours) == 1 and known:
            part = with_order_between(part, known[k], knob)
        parts.append(part)
        remarks += [remark] if remark else []
    return Estimate(setting, parts, remarks)
