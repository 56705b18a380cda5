# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values of quantities from the columns of a run."""
from dataclasses import dataclass

import numpy

from study.columns import NotEvaluated, column


@dataclass
class Values:
    """A quantity of a run: values at times, [time][component]; one time unless it is evaluated over time."""
    times: numpy.ndarray
    values: numpy.ndarray

    def at(self, times):
        """At other times, by cubic interpolation; at times of its own the values themselves."""
        return interpolate(self.times, self.values, times)


def interpolate(times, values, at):
    """Lagrange's polynomial through the four nearest of rising times; fewer if there are fewer."""
    count = min(4, len(times))
    first = numpy.clip(numpy.searchsorted(times, at) - count // 2, 0, len(times) - count)
    nodes = first[:, None] + numpy.arange(count)
    result = numpy.zeros((len(at),) + values.shape[1:])
    for j in range(count):
        weight = numpy.ones(len(at))
        for k in range(count):
            if k != j:
                weight *= (at - times[nodes[:, k]]) / (times[nodes[:, j]] - times[nodes[:, k]])
        result += weight[:, None] * values[nodes[:, j]]
    return result


def upward_passages(times, values):
    """When the values pass the middle between the largest and the smallest one upwards."""
    middle = (values.max() + values.min()) / 2
    before, after = values[:-1], values[1:]
    at = numpy.flatnonzero((before < middle) & (middle <= after))
    return times[at] + (times[at + 1] - times[at]) * (middle - before[at]) / (after[at] - before[at])


def rates(times, values, over=0):
    """Derivatives of second order: those of the parabola through a value and its neighbours, or the nearest one; where there
    are values before and after, means over a time around if it is given."""
    if len(times) < 3:
        raise NotEvaluated("a rate needs three rows")
    result = numpy.gradient(values, times, axis=0, edge_order=2)
    if over:
        inside = (times - over / 2 >= times[0]) & (times + over / 2 <= times[-1])
        after, before = (interpolate(times, values, times[inside] + shift) for shift in (over / 2, -over / 2))
        result[inside] = (after - before) / over
    return result


def series(quantity, columns):
    """Times and values [time][component] of all rows, each at the time of its step that it belongs to; or their rates."""
    times = column(columns, "Time")
    values = quantity.factor * numpy.stack(
        [sum(column(columns, name) for name in names) for names in quantity.components()], axis=1)
    if quantity.rate:
        values = rates(times, values, quantity.rate_over)
    if quantity.share_of_step < 1:
        if quantity.rate:
            raise NotEvaluated("'Rate' is that at the ends of steps: not with 'Share of step' below 1")
        times = times[:-1] + quantity.share_of_step * numpy.diff(times)
        values = values[1:]
    return times, values


def passages(quantity, times, values, columns):
    """Bounds of the last whole periods; all passages if there is no number of them."""
    signal = values[:, numpy.ptp(values, axis=0).argmax()]  # the component that moves most
    if quantity.period_of:
        signal = numpy.interp(times, columns["Time"], column(columns, quantity.period_of))
    found = upward_passages(times, signal)
    if len(found) <= max(1, quantity.periods):
        raise NotEvaluated(f"fewer than {max(1, quantity.periods)} whole periods from {times[0]:g} s "
                           f"to {times[-1]:g} s")
    return found[-1 - quantity.periods:] if quantity.periods else found


def window(quantity, columns):
    """The values that count: of the rows between two times, and at these times themselves."""
    times, values = series(quantity, columns)
    slack = 1e-9 * max(times[-1], 1e-300)
    start, until = max(quantity.start, times[0]), min(quantity.until or times[-1], times[-1])
    if quantity.evaluate == "end" and quantity.share_of_step < 1 and (quantity.until or times[-1] + 1) > times[-1] + slack:
        raise NotEvaluated(f"the last value is that of {times[-1]:g} s, which depends on the step: 'Until' must come before it")
    if start > until + slack:
        raise NotEvaluated(f"no row between {quantity.start:g} s and {quantity.until or times[-1]:g} s")
    inside = times[(times > start + slack) & (times < until - slack)]
    ends = [start, until] if until > start + slack else [until]
    whole = numpy.concatenate([ends[:1], inside, ends[1:]])
    return whole, interpolate(times, values, whole)


def mean(times, values):
    if len(times) == 1:
        return values[0]
    return numpy.trapz(values, times, axis=0) / (times[-1] - times[0])


def peak(times, values):
    """Time and value of the peak of the parabola through the largest of some values and its neighbours: which value comes
    closest to a peak depends on the step, and would look like an error of it."""
    k = int(values.argmax())
    if not 0 < k < len(values) - 1:
        return times[k], values[k]
    before, after = times[k] - times[k - 1], times[k + 1] - times[k]
    left, right = (values[k] - values[k - 1]) / before, (values[k + 1] - values[k]) / after
    curvature = (right - left) / (before + after)
    slope = (left * after + right * before) / (before + after)
    if curvature >= 0:
        return times[k], values[k]
    return times[k] - slope / (2 * curvature), values[k] - slope ** 2 / (4 * curvature)


def largest(times, values):
    return numpy.array([peak(times, each)[1] for each in values.T])


def smallest(times, values):
    return -largest(times, -values)


REDUCTIONS = {
    "end": lambda times, values: values[-1],
    "mean": mean,
    "largest": largest,
    "smallest": smallest,
    "middle": lambda times, values: (largest(times, values) + smallest(times, values)) / 2,
    "amplitude": lambda times, values: (largest(times, values) - smallest(times, values)) / 2,
    "time of largest": lambda times, values: numpy.array([peak(times, each)[0] for each in values.T]),
}


def evaluate(quantity, columns):
    """Values of a quantity; raises NotEvaluated."""
    times, values = window(quantity, columns)
    if not numpy.isfinite(values).all():
        raise NotEvaluated("not all values are numbers")
    if quantity.periods or quantity.evaluate in ("frequency", "period"):
        bounds = passages(quantity, times, values, columns)
        if quantity.evaluate in ("frequency", "period"):
            period = (bounds[-1] - bounds[0]) / (len(bounds) - 1)
            result = 1 / period if quantity.evaluate == "frequency" else period
            return Values(times[-1:], numpy.array([[result]]))
        inside = times[(times > bounds[0]) & (times < bounds[-1])]
        whole = numpy.concatenate([bounds[:1], inside, bounds[-1:]])
        times, values = whole, interpolate(times, values, whole)
    if quantity.evaluate == "over time":
        return Values(times, values)
    return Values(times[-1:], REDUCTIONS[quantity.evaluate](times, values)[None, :])
