# SPDX-License-Identifier: LGPL-2.1-or-later
"""Searches for the cheapest settings for an error: from coarse runs to finer ones, of which each is cheap beside the next."""
import math
import sys
import time

from study.campaign import readable
from study.knobs import CLOSE
from study.level import COARSER, Level, NoCoarserRun, coarser_neighbour
from study.pilot import Refused, Setting
from study.tables import percent

FIRST, LAST_FIRST = 0.25, 4.0  # factors of the first settings, of those of the scene
SAME = 1e-6  # relative, of factors
NEAR_ENOUGH = 3.0  # an error, of what is asked for, to begin with
LITTLE = 0.1  # a part of the error, of what is asked for, that does not matter
AIM = 0.9  # of the error asked for: the parts are estimates
CHEAP = 8.0  # the last run, in costs of the one that foretells its error
LARGEST_JUMP, CAREFUL_JUMP = 8.0, 4.0  # of cost, from one setting to the next; where the error is uncertain
UNCERTAIN = 0.3  # a greater error
SETTLING = 1.6  # refinement of what does not come closer yet
SMALL_JUMP = 4.0  # where orders are less than hoped for
FAR = 3.0  # a refinement of one thing beyond which nothing is foretold
FINEST = (4, 32, 256)  # factors of refinement in which settings are looked for
LEVELS = 16
HOPELESS = 6.0  # refinement of all that matters, without the error falling
MATTERS = 0.1  # of the error


def with_room(pilot, k, knob):
    """The least factor of a knob of which there are coarser ones that have not failed."""
    return COARSER * max(knob.coarsest(), CLOSE * pilot.too_coarse.get(k, 0.0))


def known_level(pilot, wanted):
    """Of the cheapest of the runs that are there already, of which all coarser neighbours are there, too, whose error is near
    to what is asked for; of the one with the least error if none is; or None."""
    def is_surrounded(setting):
        return all(coarser_neighbour(pilot, setting, k, COARSER) in pilot.values for k in range(len(setting.knobs)))

    levels = [Level(pilot, setting) for setting in sorted(pilot.values, key=pilot.costs.get) if is_surrounded(setting)]
    near = (level for level in levels if not level.remarks and level.error() <= NEAR_ENOUGH * wanted)
    return next(near, None) or min(levels, key=Level.error, default=None)


def first_level(pilot, all_knobs):
    """Of settings a quarter as fine as the scene, or as fine as needed for the run and its coarser neighbours to succeed."""
    factors, reason = [FIRST] * len(all_knobs), None
    while max(factors) <= LAST_FIRST:
        setting = Setting(all_knobs, tuple(knob.nearest(max(factor, with_room(pilot, k, knob)))
                                           for k, (knob, factor) in enumerate(zip(all_knobs, factors))))
        if pilot.run(setting) is not None:
            try:
                return Level(pilot, setting)
            except NoCoarserRun as missing:
                reason = str(missing)
                factors[missing.number] *= 2
        else:
            reason = f"the run with {setting.name(pilot.study)} fails: {pilot.failures[setting]}"
            factors = [2 * factor for factor in factors]
    raise Refused(reason)


def cheapest(level, model, wanted):
    """Factors by a model of a level's error; the finest there are if none are fine enough. Steps are no longer than a run
    with outputs makes them."""
    knobs, factors = level.setting.knobs, level.setting.factors
    low = [max(with_room(level.pilot, k, knob), knob.least_with_outputs(), factor / COARSER)
           for k, (knob, factor) in enumerate(zip(knobs, factors))]
    for finest in FINEST:
        choices = [knob.choices(least, max(least, factor * finest)) or [knob.nearest(least)]
                   for knob, least, factor in zip(knobs, low, factors)]
        found = model.cheapest(wanted, choices)
        if found:
            return found
    return tuple(each[-1] for each in choices)


def between(level, factors, jump):
    """The setting on the way to other factors that is dearer by a jump only, and in nothing much finer."""
    whole = max(1.0, level.model.expected_cost(factors))
    finest = max(1.0, max(other / own for own, other in zip(level.setting.factors, factors)))
    share = min([1.0] + [math.log(most) / math.log(there) for most, there in ((jump, whole), (FAR, finest)) if there > most])
    return Setting(level.setting.knobs, tuple(
        knob.nearest(max(own * (other / own) ** share, knob.least_with_outputs(), with_room(level.pilot, k, knob)))
        for k, (knob, own, other) in enumerate(zip(level.setting.knobs, level.setting.factors, factors))))


def settled(level):
    """A setting with what does not come closer yet refined."""
    return Setting(level.setting.knobs, tuple(
        knob.nearest(max(factor if part.falls else factor * SETTLING, knob.least_with_outputs()))
        for knob, factor, part in zip(level.setting.knobs, level.setting.factors, level.model.parts)))


def next_setting(level, wanted):
    """The setting to run after a level, and whether its error can be foretold by the level.

    What is foretold best is near, and a level is the cheaper the further the last run is: one that costs an eighth of it is
    the aim, on a way that theory tells, so that nothing is run that is finer than needed."""
    level.see_orders()
    hope = level.hopeful()
    way = cheapest(level, hope, wanted)
    jump = hope.expected_cost(way)
    if jump > 2 * CHEAP:
        return between(level, way, min(jump / CHEAP, CAREFUL_JUMP if level.error() > UNCERTAIN else LARGEST_JUMP)), False
    if level.remarks:
        return settled(level), False
    factors = cheapest(level, level.model, wanted)
    jump = level.model.expected_cost(factors)
    is_far = max(other / own for own, other in zip(level.setting.factors, factors)) > FAR
    if jump > 2 * CHEAP or is_far:
        return between(level, factors, SMALL_JUMP), False
    return Setting(level.setting.knobs, factors), True


class Search:
    """Levels and the settings tried between them. The last setting is accurate enough, and its run, with outputs, is the one
    that the user gets. Raises Refused."""

    def __init__(self, pilot, all_knobs, wanted):
        self.pilot, self.wanted = pilot, wanted
        self.all_knobs, self.levels = all_knobs, []
        self.left = []  # settings whose coarser neighbours have failed
        self.setting, self.error = None, math.inf

    def run(self):
        self.levels.append(known_level(self.pilot, self.wanted) or first_level(self.pilot, self.all_knobs))
        self.say()
        while self.error > self.wanted:
            self.refine()

    def refine(self):
        """Run the next setting, and find its error."""
        level = self.levels[-1]
        setting, is_foretold = next_setting(level, AIM * self.wanted)
        if setting == level.setting and not is_foretold:
            raise Refused(f"nothing can be refined further: the error is still about {percent(level.error())}")
        self.refuse_what_takes_too_long(setting)
        if self.pilot.run_with_outputs(setting) is None:
            self.turn_back(setting)
            return
        self.setting = setting
        if is_foretold and self.is_accurate(level, lambda: level.confirmed_error(setting)):
            return
        try:
            self.levels.append(Level(self.pilot, setting, level, LITTLE * self.wanted))
        except NoCoarserRun:
            if setting in self.left:
                raise
            self.left.append(setting)  # the next one is finer in what fails
            return
        self.say()
        late = self.levels[-1]
        if self.is_accurate(late, lambda: math.inf if late.remarks else late.error()):
            return
        if len(self.levels) > LEVELS:
            raise Refused(f"after {LEVELS} refinements the error is still about {percent(self.levels[-1].error())}")
        self.refuse_what_does_not_converge()

    def is_accurate(self, level, error_by):
        """Is an error by a level, which may be None if it is not known, as small as wanted, also once all of the level's parts
        are measured? Then it is that of the search."""
        error = error_by()
        if error is not None and error <= self.wanted and not level.is_complete():
            try:
                level.complete()
            except NoCoarserRun:
                return False
            error = error_by()
        if error is None or error > self.wanted:
            return False
        self.error = error
        return True

    def turn_back(self, setting):
        """From one that fails to those that are nowhere coarser than the last level; Refused if it is not coarser itself."""
        coarser = [k for k, (factor, own) in enumerate(zip(setting.factors, self.levels[-1].setting.factors))
                   if factor < own * (1 - SAME) and factor > self.pilot.too_coarse.get(k, 0.0)]
        if not coarser:
            raise Refused(f"the run with {setting.name(self.pilot.study)} fails: {self.pilot.failures[setting]}")
        for k in coarser:
            self.pilot.too_coarse[k] = setting.factors[k]

    def expected_error(self):
        """Of the last setting, with parts that cancel each other; zero where nothing changes anything."""
        model = self.levels[-1].model
        return self.error * model.sum(self.setting.factors) / (model.error(self.setting.factors) or 1.0)

    def parts(self):
        """Of the error of the last setting."""
        model = self.levels[-1].model
        scale = self.error / (model.error(self.setting.factors) or 1.0)
        return [scale * part.size * (factor / part.factor) ** -part.order for part, factor in
                zip(model.parts, self.setting.factors)]

    def cost_of(self, wanted):
        """Core seconds that an error by the model of the last level would take, or that of the finest settings looked at where
        none are fine enough, and whether some are: as costs grow from those of the last run."""
        level = self.levels[-1]
        factors, last = cheapest(level, level.model, wanted), self.setting or level.setting
        cost = self.pilot.costs[last] * float(level.model.cost(factors) / level.model.cost(last.factors))
        return cost, level.model.error(factors) <= wanted

    def cost_of_half(self):
        """The same for half of the error of the last setting, in which more may have been seen than the model foretold."""
        return self.cost_of(self.levels[-1].model.error(self.setting.factors) / 2)

    def refuse_what_takes_too_long(self, setting):
        """Where the next run does not fit into the time, or, once values come closer, the last one."""
        if not self.pilot.deadline:
            return
        left, level = self.pilot.deadline - time.monotonic(), self.levels[-1]
        following, last = (self.pilot.seconds(level.setting, float(level.model.cost(factors))) for factors in (
            setting.factors, cheapest(level, level.model, AIM * self.wanted)))
        is_sure = level.orders_are_seen() and not level.remarks
        if following > left or (is_sure and last > left):
            raise Refused(f"it would take about {readable(max(following, last))}, but {readable(max(left, 0))} of the time "
                          f"allowed are left; so far the error is about {percent(level.error())}")

    def refuse_what_does_not_converge(self):
        """A setting that is much finer than an earlier one in all that the error came from, and coarser in nothing, without a
        smaller error: a chaotic flow, for example."""
        late = self.levels[-1]
        for early in self.levels[:-1]:
            ratios = [fine / coarse for fine, coarse in zip(late.setting.factors, early.setting.factors)]
            is_finer = min(ratios) > 0.99 and all(ratio > HOPELESS for ratio, part in zip(ratios, early.model.parts)
                                                  if part.size > MATTERS * early.error())
            if is_finer and late.size_of_error() > 0.8 * early.size_of_error():
                errors = ", ".join(percent(each.error()) for each in self.levels)
                raise Refused("runs do not come closer to each other as they are refined: the estimates are "
                              f"{errors}. Flows that are chaotic have no accurate values over time: ask for a mean with "
                              "--as mean, or for a shorter time")

    def say(self):
        """Where the last level stands."""
        level = self.levels[-1]
        parts = ", ".join(f"{knob.name} {percent(part.size)} (order {part.order:.1f}{'' if part.seen is not None else ' assumed'})"
                          for knob, part in zip(level.setting.knobs, level.model.parts))
        print(f"error about {percent(level.error())}: {parts}", file=sys.stderr, flush=True)
