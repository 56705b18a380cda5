# SPDX-License-Identifier: LGPL-2.1-or-later
"""An error as a sum of parts, one for each thing that can be refined: part_k = size_k (factor_k)^-order_k; and the cheapest
factors for an error that is asked for."""
import math
from dataclasses import dataclass


@dataclass
class Part:
    """Of the error, with the factor of refinement at which it was measured: by the difference to a value that is coarser in
    this thing by a ratio. The size of the part follows with one order, how it falls further with another: where no order
    has been seen, it is prudent to take a lower one for the size."""
    difference: float  # relative
    ratio: float
    factor: float
    order_of_size: float
    order: float
    growth: float  # of the cost over the factor

    @property
    def size(self):
        return self.difference / (self.ratio ** self.order_of_size - 1)

    def at(self, factor):
        """Its size with another factor."""
        return self.size * (factor / self.factor) ** -self.order


def total(parts, factors):
    return sum(part.at(factor) for part, factor in zip(parts, factors))


def cost_ratio(parts, factors):
    """Of a run with these factors to that with those of the parts."""
    return math.prod((factor / part.factor) ** part.growth for part, factor in zip(parts, factors))


def cheapest(parts, wanted, least):
    """Factors with the least cost for an error: every part has a share of it in proportion to growth / order, but for those
    that have less already with the least factor that is sensible."""
    factors, free, left = list(least), [k for k, part in enumerate(parts) if part.size > 0], wanted
    while free:
        weight = sum(parts[k].growth / parts[k].order for k in free)
        trial = {k: parts[k].factor * (parts[k].size * weight * parts[k].order / (left * parts[k].growth)) **
                 (1 / parts[k].order) for k in free}
        small = [k for k in free if trial[k] < least[k]]
        if not small:
            for k in free:
                factors[k] = trial[k]
            break
        left -= sum(parts[k].at(least[k]) for k in small)
        free = [k for k in free if k not in small]
    return factors
