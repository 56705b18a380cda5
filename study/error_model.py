# SPDX-License-Identifier: LGPL-2.1-or-later
"""An error as a sum of parts, one for each thing that can be refined, which fall with powers of its refinement; and the
cheapest factors for an error that is asked for."""
import itertools
from dataclasses import dataclass, field, replace

import numpy


@dataclass
class Part:
    """Of the error: what one thing contributes, measured by a run that is coarser in it."""
    difference: numpy.ndarray  # to that run [time, component], in sizes of the quantity
    ratio: float  # of the factors of both runs
    factor: float  # of refinement, at which it was measured
    order: float
    expected: float  # order, by theory
    growth: float  # of the cost over the factor, as measured
    expected_growth: float
    seen: float = None  # the order that values show; nan: they do not come closer
    falls: bool = True  # do values come closer?
    caution: float = 1.0  # factor of the error, where the difference may be small by chance
    differences: list = field(default_factory=list)  # of all levels that tell the order, the last one first

    def error(self):
        """What is missing from the limit."""
        return self.difference / (self.ratio ** self.order - 1)

    @property
    def size(self):
        """Of what is missing, with caution."""
        return self.caution * float(numpy.sqrt(numpy.mean(numpy.square(self.error()))))

    def hopeful(self):
        """With the order by theory."""
        return replace(self, order=self.expected)


class ErrorModel:
    """(Q3), (Q4): errors and costs of factors that are near those of a setting, which are its own ones. `overhead`: of the cost
    of that setting, what does not grow."""

    def __init__(self, parts, own, overhead=0.0):
        self.parts, self.own, self.overhead = parts, numpy.array(own), overhead
        self.factors = numpy.array([part.factor for part in parts])
        self.orders = numpy.array([part.order for part in parts])
        errors = [part.caution * part.error() for part in parts]
        self.products = numpy.array([[numpy.mean(one * other) for other in errors] for one in errors])

    def errors(self, factors):
        """Of many settings, [setting][thing]: the largest of all sums of parts, so that nothing is owed to parts that cancel
        each other by chance."""
        weights = (factors / self.factors) ** -self.orders
        largest = numpy.zeros(len(factors))
        for chosen in itertools.product((0, 1), repeat=len(self.parts)):
            some = weights * chosen
            largest = numpy.maximum(largest, numpy.einsum("nk,kl,nl->n", some, self.products, some))
        return numpy.sqrt(largest)

    def error(self, factors):
        return float(self.errors(numpy.array([factors]))[0])

    def sum(self, factors):
        """Of a setting: the size of the sum of all parts, be it that they cancel each other."""
        weights = (numpy.array(factors) / self.factors) ** -self.orders
        return float(numpy.sqrt(max(0.0, weights @ self.products @ weights)))

    def change(self, factors):
        """What the quantity changes by from the setting to another one, in sizes of the quantity."""
        weights = (numpy.array(factors) / self.factors) ** -self.orders - (self.own / self.factors) ** -self.orders
        return sum(part.error() * weight for part, weight in zip(self.parts, weights))

    def cost(self, factors):
        """In costs of the setting, as they have been seen to grow."""
        growing = numpy.prod((factors / self.own) ** [part.growth for part in self.parts], axis=-1)
        return self.overhead + (1 - self.overhead) * growing

    def expected_cost(self, factors):
        """The same as they should grow, were runs long."""
        return numpy.prod((factors / self.own) ** [part.expected_growth for part in self.parts], axis=-1)

    def cheapest(self, wanted, choices):
        """Of the factors to choose from for each thing those with the least cost for an error; None if none are fine enough."""
        factors = numpy.array(list(itertools.product(*choices)))
        enough = factors[self.errors(factors) <= wanted]
        return tuple(enough[self.cost(enough).argmin()]) if len(enough) else None
