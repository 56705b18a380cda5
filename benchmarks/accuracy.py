# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far a series of values over time is from a reference, and with which order it comes closer."""
import bisect
import math
from dataclasses import dataclass

SHARES = [k / 20 for k in range(31)]  # of a step


@dataclass
class Series:
    """Values at rising times [s]."""
    times: list
    values: list

    def at(self, time):
        """The value at a time [s], linear in between; None outside."""
        slack = 1e-9 * (self.times[-1] - self.times[0])
        if not self.times[0] - slack <= time <= self.times[-1] + slack:
            return None
        right = min(max(bisect.bisect_left(self.times, time - slack), 1), len(self.times) - 1)
        t0, t1 = self.times[right - 1:right + 1]
        v0, v1 = self.values[right - 1:right + 1]
        return v0 + (v1 - v0) * (time - t0) / (t1 - t0)


def series_of_mean(times, values, share):
    """What each step from times[n] to times[n+1] gives for the time at this share of it; the values begin with
    one for times[0], at which no step ends."""
    return Series([(1 - share) * t0 + share * t1 for t0, t1 in zip(times, times[1:])], list(values[1:]))


def errors(series, reference):
    """Norm over time of the difference, over that of the reference, and the largest difference over the largest
    value of the reference, both at the times of the series at which there is a reference; (nan, nan) without any."""
    pairs = [(value, reference.at(time)) for time, value in zip(series.times, series.values)]
    pairs = [(value, wanted) for value, wanted in pairs if wanted is not None]
    norm = math.sqrt(sum(wanted * wanted for _, wanted in pairs))
    if norm == 0:
        return math.nan, math.nan
    return (math.sqrt(sum((value - wanted)**2 for value, wanted in pairs)) / norm,
            max(abs(value - wanted) for value, wanted in pairs) / max(abs(wanted) for _, wanted in pairs))


def order(coarse, fine, ratio=2):
    """Of convergence, from the errors with a step and with that step over the ratio; nan without both of them."""
    return math.log(coarse / fine, ratio) if coarse > 0 and fine > 0 else math.nan


def own_order(series):
    """Of three series, each with half the step of the one before: of the difference between neighbours. The finest
    one is no reference, so that it is not too good by what it lacks itself."""
    coarse, middle, fine = series
    return order(errors(coarse, middle)[0], errors(middle, fine)[0])


def fitted_share(times, values, reference):
    """The share of a step at which values that belong to steps fit the reference best."""
    return min(SHARES, key=lambda share: errors(series_of_mean(times, values, share), reference)[0])
