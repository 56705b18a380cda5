# SPDX-License-Identifier: LGPL-2.1-or-later
"""What part of the error of a setting comes from what, by runs that are coarser in one thing."""
import math

from study import convergence, orders
from study.error_model import ErrorModel, Part
from study.pilot import Refused

COARSER, NEAR = 2.0, 1.4  # neighbours, in one thing; factor by which a run that is there already may be beside that
NEARLY = 1.1  # factor between settings that are nearly the same
CORRECTIONS = 2  # times that parts and what they foretell of each other are found
LARGE = 0.5  # a difference, in sizes of the quantity, that tells nothing of smaller ones
SLOWEST_GROWTH, STEEPEST_GROWTH = 0.5, 1.5  # of cost, in growths expected; others are noise
MOST_OVERHEAD = 0.9  # of the cheapest run
TELLING = 0.25  # a change, of the error, that tells something of it, if one was foretold
WORTH_TELLING = 1.2  # a caution
ALIKE = 0.6  # of a change, what may not have been foretold


class NoCoarserRun(Refused):
    """Nothing can be told of a setting, since what is coarser in one thing, the knob of a number, fails."""

    def __init__(self, reason, number):
        super().__init__(reason)
        self.number = number


def coarser_neighbour(pilot, setting, k, ratio):
    """With one knob coarser by a ratio, or about so much if there is such a run already; None where that is not sensible."""
    knob, own = setting.knobs[k], setting.factors[k]
    factor = knob.nearest(max(own / ratio, knob.coarsest()))
    there = [other.factors[k] for other in pilot.values if other == setting.with_factor(k, other.factors[k])
             and ratio / NEAR < own / other.factors[k] < ratio * NEAR]
    if there:
        factor = min(there, key=lambda other: abs(math.log(own / other / ratio)))
    return setting.with_factor(k, factor) if factor < 0.8 * own else None


def nearly_neighbour(pilot, setting, k):
    """A run that is there already, coarser in one thing and nearly the same in all others; None without any."""
    def ratio(other):
        return setting.factors[k] / other.factors[k]

    def is_near(other):
        others = [own / its for number, (own, its) in enumerate(zip(setting.factors, other.factors)) if number != k]
        return COARSER / NEAR < ratio(other) < COARSER * NEARLY and all(1 / NEARLY < each < NEARLY for each in others)

    return min(filter(is_near, pilot.values), key=lambda other: abs(math.log(ratio(other) / COARSER)), default=None)


class Level:
    """A setting, of whose error each part is known by a run that is coarser in one thing, or two. `before`: an earlier level
    to tell orders, and parts of the error below `little`, which are not measured again. Raises NoCoarserRun."""

    def __init__(self, pilot, setting, before=None, little=0.0):
        self.pilot, self.setting, self.before, self.remarks = pilot, setting, before, []
        numbers = range(len(setting.knobs))
        self.chains = [before.chains[k] if before and before.foretold_size(k, setting) < little else None for k in numbers]
        self.measure([k for k in numbers if not self.chains[k]])

    def complete(self):
        """Measure all parts with this setting."""
        self.measure([k for k, chain in enumerate(self.chains) if chain[0] != self.setting])

    def measure(self, numbers):
        """The parts of some knobs, by neighbours that are coarser in one thing and run at the same time."""
        neighbours = {k: nearly_neighbour(self.pilot, self.setting, k) or coarser_neighbour(self.pilot, self.setting, k, COARSER)
                      for k in numbers}
        self.pilot.run_all([each for each in neighbours.values() if each])
        for k, neighbour in neighbours.items():
            if neighbour not in self.pilot.values:
                if neighbour:
                    self.pilot.too_coarse[k] = max(neighbour.factors[k], self.pilot.too_coarse.get(k, 0.0))
                raise NoCoarserRun(f"{self.setting.knobs[k].name}: no coarser run has succeeded", k)
            self.chains[k] = [self.setting, neighbour]
        self.evaluate()

    def foretold_size(self, k, setting):
        """Of the part of one thing of the error of a finer setting; without limit where it does not fall yet."""
        part = self.model.parts[k]
        return part.size * (setting.factors[k] / part.factor) ** -part.order if part.falls and part.seen is not None else math.inf

    def is_complete(self):
        """Are all parts measured with this setting?"""
        return all(chain[0] == self.setting for chain in self.chains)

    def see_orders(self):
        """By a second neighbour of each knob of which no order has been seen."""
        neighbours = {k: coarser_neighbour(self.pilot, self.setting, k, COARSER ** 2)
                      for k, part in enumerate(self.model.parts) if part.seen is None}
        neighbours = {k: each for k, each in neighbours.items() if each and each.factors[k] < 0.8 * self.chains[k][-1].factors[k]}
        self.pilot.run_all(neighbours.values())
        for k, neighbour in neighbours.items():
            if neighbour in self.pilot.values:
                self.chains[k] = self.chains[k] + [neighbour]
        self.evaluate()

    def evaluate(self):
        """The parts of the error, by all runs that there are."""
        self.times = self.pilot.times(sum(self.chains, [self.setting]))
        (own,) = self.pilot.compare([self.setting], self.times)
        self.scale = convergence.norm(own)
        if self.scale == 0:
            raise Refused("the quantity is zero all the time: choose another one with --of")
        self.overhead = self.find_overhead()
        values = [[each / self.scale for each in self.pilot.compare(chain, self.times)] for chain in self.chains]
        self.model = self.model_of(values)
        if any(chain[1] != chain[0].with_factor(k, chain[1].factors[k]) for k, chain in enumerate(self.chains)):
            for _ in range(CORRECTIONS):
                self.model = self.model_of([self.alone(k, each) for k, each in enumerate(values)])
        self.remarks = [f"{knob.name}: values do not come closer yet"
                        for knob, part in zip(self.setting.knobs, self.model.parts) if not part.falls]
        self.cautions = [f"{knob.name}: values have come closer than theory foretells, by chance perhaps; its part is taken "
                         f"{part.caution:.1f} times as large"
                         for knob, part in zip(self.setting.knobs, self.model.parts) if part.caution > WORTH_TELLING]

    def model_of(self, values):
        parts = [self.part(k, each) for k, each in enumerate(values)]
        return ErrorModel(parts, self.setting.factors, self.overhead / self.pilot.costs[self.setting])

    def alone(self, k, values):
        """Values of the settings of a chain as they would be if these were coarser in one thing only, by the parts of the
        others."""
        first = self.chains[k][0].factors
        others = [each.factors[:k] + first[k:k + 1] + each.factors[k + 1:] for each in self.chains[k]]
        return [value + self.model.change(first) - self.model.change(factors) for value, factors in zip(values, others)]

    def part(self, k, values):
        """That of one knob, by values of settings that are coarser and coarser in it, in sizes of the quantity."""
        knob, chain = self.setting.knobs[k], self.chains[k]
        factors = [each.factors[k] for each in chain]
        own = orders.of_chain(factors, values, self.scale)
        before = self.before.model.parts[k] if self.before else None
        differences = orders.joined(own, before.differences if before else [])
        seen = self.order_seen(own[0], before)
        if seen is None and len(chain) > 2 and own[0].size > 0:
            seen = convergence.observed_order([1 / factor for factor in factors[::-1]], values[::-1])
        order = orders.order_to_use(seen, differences, knob.order)
        falls = own[0].size < LARGE * self.scale and not (seen is not None and math.isnan(seen))
        caution = orders.caution(own[0], before.differences, knob.order) if before else 1.0
        return Part(values[1] - values[0], own[0].ratio, factors[0], order, knob.order, self.growth(k, own[0].ratio),
                    knob.growth, seen, falls, caution, differences)

    @staticmethod
    def order_seen(own, before):
        """The order between a difference of this level and that of an earlier one; as the earlier level has seen it, if factors
        are too close to tell one; None if none was seen or differences have grown."""
        if not before or not before.differences:
            return None
        early = before.differences[0]
        if own.is_apart(early):
            return orders.order_between(own, early)
        return before.seen if before.falls and not orders.has_grown(own, early, before.order) else None

    def growth(self, k, ratio):
        """Of the cost without outputs and what does not grow."""
        knob, chain = self.setting.knobs[k], self.chains[k]
        if chain[0] != self.setting:
            return self.before.model.parts[k].growth
        fine, coarse = (self.cost_alone(k, each) - self.overhead for each in chain[:2])
        seen = math.log(fine / coarse) / math.log(ratio)
        return min(max(seen, SLOWEST_GROWTH * knob.growth), STEEPEST_GROWTH * knob.growth)

    def cost_alone(self, k, other):
        """Of a setting, as it would be if it were coarser in one thing only, by growths expected of the others."""
        return self.pilot.costs[other] * math.prod((own / its) ** knob.growth for number, (knob, own, its) in enumerate(zip(
            self.setting.knobs, self.setting.factors, other.factors)) if number != k)

    def find_overhead(self):
        """What all runs cost alike: what is left of coarser ones by the growths expected, the least of them all, and a little
        less than the cheapest run."""
        found = [MOST_OVERHEAD * min(self.pilot.costs[each] for each in self.pilot.values)]
        for k, (own, neighbour, *_) in enumerate(self.chains):
            if own == self.setting:
                share, cost = (neighbour.factors[k] / own.factors[k]) ** own.knobs[k].growth, self.cost_alone(k, neighbour)
                found += [MOST_OVERHEAD * cost, (cost - share * self.pilot.costs[own]) / (1 - share)]
        return max(0.0, min(found))

    def error(self):
        """Relative."""
        return self.model.error(self.setting.factors)

    def size_of_error(self):
        """In the unit of the quantity, which tells whether it falls from level to level: sizes of the quantity differ."""
        return self.scale * self.error()

    def orders_are_seen(self):
        return all(part.seen is not None for part in self.model.parts)

    def hopeful(self):
        """The model with the orders that theory promises."""
        return ErrorModel([part.hopeful() for part in self.model.parts], self.setting.factors, self.model.overhead)

    def confirmed_error(self, setting):
        """That of another setting, whose run tells whether the parts are what they seem: larger by as much as the quantity
        has changed more than was foretold; None if it changes in another way, or by nothing where that was not foretold."""
        own, other = self.pilot.compare([self.setting, setting], self.times)
        change, foretold = (other - own) / self.scale, self.model.change(setting.factors)
        error, size, expected = self.model.error(setting.factors), convergence.norm(change), convergence.norm(foretold)
        tells_too_little = size < TELLING * error < expected
        if tells_too_little or convergence.norm(change - foretold) > max(ALIKE * size, error / 2):
            return None
        more = size / expected if size > error / 2 else 1.0
        return error * max(1.0, more) * self.scale / convergence.norm(other)

