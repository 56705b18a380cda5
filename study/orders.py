# SPDX-License-Identifier: LGPL-2.1-or-later
"""Orders of one thing that is refined, by differences to runs that are coarser in it, at several factors of refinement."""
import math
from dataclasses import dataclass

import numpy

from study import convergence

SMALLEST_ORDER = 0.7
UNSEEN_ORDER = 1.5  # a prudent one, where none has been seen
APART = 1.4  # factor between two settings that can tell an order
GROWN = 1.5  # a difference, of that foretold, which is no longer that of the order
MOST_CAUTION = 3.0
SCATTER, DISTANCE = 0.2, 0.5  # expected: of logarithms of differences, and of an order from that of theory


@dataclass
class Difference:
    """Between a run at a factor of refinement and one that is coarser by a ratio, in the unit of the quantity."""
    factor: float
    ratio: float
    size: float

    def is_apart(self, other):
        """Can both tell an order?"""
        return not 1 / APART < self.factor / other.factor < APART and self.size > 0 and other.size > 0

    def constant(self, order):
        """C of a difference C s^-p (r^p - 1), of one order or many."""
        return self.size * self.factor ** order / (self.ratio ** order - 1)


def of_chain(factors, values, scale):
    """The differences between values that follow each other, of settings that are coarser and coarser."""
    return [Difference(fine, fine / coarse, scale * convergence.norm(other - own))
            for fine, coarse, own, other in zip(factors, factors[1:], values, values[1:])]


def joined(late, early):
    """The last difference and those before it that tell something of how they fall: of those at nearly the same factor the later
    one, and none before they have begun to fall."""
    found = list(late[:1])
    for each in late[1:] + early:
        if each.is_apart(found[-1]) and each.factor < found[-1].factor:
            if each.size <= found[-1].size:
                break
            found.append(each)
    return found


def order_between(one, other):
    """p by two differences that are apart; nan if they do not fall."""
    coarse, fine = sorted((one, other), key=lambda each: each.factor)
    pairs = [(each.ratio / each.factor, 1 / each.factor) for each in (coarse, fine)]
    return convergence.order_of_pairs(*pairs, coarse.size, fine.size)


def has_grown(late, early, order):
    """Is a difference more than an earlier one at nearly the same factor has foretold?"""
    return late.size * early.size > 0 and late.constant(order) > GROWN * early.constant(order)


def caution(late, early, expected):
    """The factor by which a difference is smaller than all earlier ones and theory foretell, as far as it is trusted: two grids
    agree by chance, too."""
    foretold = [each.constant(expected) for each in early if late.is_apart(each) and late.factor > each.factor]
    return min(max(min(foretold) / late.constant(expected), 1.0), MOST_CAUTION) if foretold else 1.0


def likely(differences, expected):
    """The order by which differences fall, by least squares of their logarithms, with that of theory as one more observation.
    How much logarithms scatter is what they show, with what is expected as one more of them."""
    tried = numpy.linspace(SMALLEST_ORDER, 2 * expected + 1, 400)
    logarithms = numpy.log([each.constant(tried) for each in differences])
    squares = numpy.sum(numpy.square(logarithms - logarithms.mean(axis=0)), axis=0)
    scatter = (SCATTER ** 2 + squares.min()) / (len(differences) - 1)
    return float(tried[numpy.argmin(squares / scatter + numpy.square((tried - expected) / DISTANCE))])


def order_to_use(seen, differences, expected):
    """The likely one; one greater than expected is chance. A prudent one if none has been seen."""
    if seen is None:
        return min(expected, UNSEEN_ORDER)
    if math.isnan(seen):
        return SMALLEST_ORDER
    order = likely(differences, expected) if len(differences) > 1 else seen
    return min(max(order, SMALLEST_ORDER), expected)
