# SPDX-License-Identifier: LGPL-2.1-or-later
"""Orders of convergence and limits of sequences over lengths of steps or cells (Roache, Annu. Rev. Fluid Mech. 29
(1997) 123)."""
import math
from dataclasses import dataclass

import numpy

LARGEST_ORDER = 4  # a greater one is chance
SMALLEST_ORDER = 0.5  # with a smaller one, the limit is far from all that was computed
ALIGNED = 0.5  # of two differences, for one to be foretold by the other
DOUBLED = 2.0  # a ratio of lengths
SURE, UNSURE = 1.25, 3.0  # factors of safety: the order is seen twice, or once


def norm(values):
    """Root of the mean square."""
    return math.sqrt(numpy.mean(numpy.square(values)))


def order(lengths, coarse_difference, fine_difference):
    """p of differences between three values with errors C h^p; nan if they do not fall."""
    h1, h2, h3 = lengths
    return order_of_pairs((h1, h2), (h2, h3), coarse_difference, fine_difference)


def order_of_pairs(coarse, fine, coarse_difference, fine_difference):
    """p of differences between values with errors C h^p, at two pairs of lengths; nan if they do not fall."""
    def excess(p):
        return (coarse[0] ** p - coarse[1] ** p) / (fine[0] ** p - fine[1] ** p) - coarse_difference / fine_difference

    if not coarse_difference > 0 or not fine_difference > 0:
        return math.nan
    low, high = 0.01, 12.0
    if excess(low) > 0:
        return math.nan
    if excess(high) < 0:
        return high
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    return low


def order_to_limit(lengths, errors):
    """p of two errors."""
    if not (errors[0] > 0 and errors[1] > 0):
        return math.nan
    return math.log(errors[0] / errors[1]) / math.log(lengths[0] / lengths[1])


@dataclass
class Limit:
    """Where a sequence leads: its limit, how far that may be off, the order, and what is wrong with it ("")."""
    value: numpy.ndarray
    uncertainty: float
    order: float
    remark: str


def alignment(values):
    """Of the last two differences, 1 if they point the same way, -1 if the last one leads back, which is all there is for a
    single number; differences at the points of a field may have little to do with each other and fall nevertheless."""
    first, second = values[-2] - values[-3], values[-1] - values[-2]
    lengths = norm(first) * norm(second)
    return numpy.mean(first * second) / lengths if lengths > 0 else 0.0


def observed_order(lengths, values):
    """From the differences of the last three values; nan if they do not fall, or turn back."""
    if len(values) < 3:
        return math.nan
    if alignment(values) < -ALIGNED:
        return math.nan
    return order(lengths[-3:], norm(values[-2] - values[-3]), norm(values[-1] - values[-2]))


def limit(lengths, values):
    """Of values with falling lengths, by the last three, or fewer."""
    finest = values[-1]
    if len(values) < 2:
        return Limit(finest, math.inf, math.nan, "was not refined")
    last, ratio = norm(values[-1] - values[-2]), lengths[-2] / lengths[-1]
    if last == 0:
        moved = max((norm(value - finest) for value in values[:-2]), default=0.0)
        return Limit(finest, UNSURE * moved, math.nan, "ends in values that are the same" if moved else "")
    cautious = UNSURE * last / (min(ratio, DOUBLED) - 1)  # first order from one step to the next, be it a large one
    if len(values) < 3:
        return Limit(finest, cautious, math.nan, "has two values only: no order is known")
    p = observed_order(lengths, values)
    if math.isnan(p):
        largest = max(last, norm(values[-2] - values[-3]))
        return Limit(finest, UNSURE * largest, math.nan,
                     "goes up and down" if alignment(values) < -ALIGNED else "does not come closer")
    if p > LARGEST_ORDER:
        return Limit(finest, cautious, p, f"comes closer with an order above {LARGEST_ORDER}, which is chance")
    share = 1 / (ratio ** max(p, SMALLEST_ORDER) - 1)
    seen_twice = len(values) > 3 and abs(observed_order(lengths[:-1], values[:-1]) - p) < 0.5
    slow = p < SMALLEST_ORDER
    leads_on = alignment(values) > ALIGNED
    factor = SURE if seen_twice and leads_on and not slow else UNSURE
    return Limit(finest + share * (values[-1] - values[-2]) if leads_on else finest, factor * share * last, p,
                 "converges slowly" if slow else "")
