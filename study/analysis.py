# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the runs of a study say: errors, orders, what they cost, and which part of an error comes from what."""
import math
import os
from dataclasses import dataclass, field

import numpy

from study import columns, convergence, quantities, references
from study.cases import variant


@dataclass
class Share:
    """Of an error: how far refining one thing alone moves the value, relative to the scale."""
    name: str
    size: float
    uncertainty: float
    remark: str


@dataclass
class Advice:
    """The cheapest settings for an error that all finer ones keep, too, and where that error comes from."""
    level: float
    case: object  # None: no run is that accurate
    shares: list


@dataclass
class QuantityResults:
    """A quantity in all cases."""
    quantity: object
    values: dict  # {case: values [time][component]}
    missing: dict  # {case: why there is no value}
    reference: object
    scale: float
    errors: dict = field(default_factory=dict)  # relative
    largest: dict = field(default_factory=dict)  # differences, relative to the reference's largest value

    def uncertainty(self):
        """Relative, of the reference."""
        return self.reference.uncertainty / self.scale

    def made_reference(self, case):
        """Whether a run's own values are the reference, so that nothing is known of its error but the uncertainty."""
        return self.errors[case] == 0 and self.reference.uncertainty > 0

    def is_scalar(self):
        return next(iter(self.values.values())).size == 1


class Analysis:
    """Of the results of a study's campaign."""

    def __init__(self, program, study, results, folders):
        self.study, self.results, self.folders = study, results, folders
        self.quantities, self.unevaluated = [], {}
        data = {}
        for case in sorted(results, key=lambda case: case.index):
            if not results[case]["failure"]:
                try:
                    data[case] = self.read(folders[case])
                except columns.NotEvaluated as reason:
                    results[case] = {**results[case], "failure": str(reason)}
        for quantity in study.quantities:
            try:
                self.quantities.append(self.analyse(program, quantity, data))
            except (references.NoReference, columns.NotEvaluated) as reason:
                self.unevaluated[quantity.name] = str(reason)

    @staticmethod
    def read(folder):
        return columns.read(os.path.join(folder, "statistics"))

    def analyse(self, program, quantity, data):
        evaluated, missing = {}, {}
        for case in data:
            try:
                evaluated[case] = quantities.evaluate(quantity.in_case(case.settings(self.study)), data[case])
            except columns.NotEvaluated as reason:
                missing[case] = str(reason)
        if not evaluated:
            raise columns.NotEvaluated(next(iter(missing.values()), "no run has succeeded"))
        times, values = references.on_common_times(quantity, evaluated)
        reference = references.make(program, self.study, quantity, times, values)
        scale = quantity.scale or convergence.norm(reference.values)
        if not scale > 0:
            raise references.NoReference("the reference is zero: give a 'Scale'")
        result = QuantityResults(quantity, values, missing, reference, scale)
        result.errors = {case: convergence.norm(value - reference.values) / scale for case, value in values.items()}
        top = numpy.abs(reference.values).max() or scale
        result.largest = {case: numpy.abs(value - reference.values).max() / top for case, value in values.items()}
        return result

    def cost(self, case):
        """In the unit of the study's `Cost`."""
        return self.results[case][self.study.cost]

    def curve(self, result, case, axis):
        """Cases that differ in one refinement alone, coarse first, which have values."""
        candidates = [case.with_value(axis, k) for k in range(len(self.study.variations[axis].names))]
        return [each for each in candidates if each in result.values]

    def bases(self, result):
        """One case for each variant, from which refinements are looked at."""
        return list(references.base_cases(self.study, result.values).values())

    def orders(self, result):
        """[(case, axis, own order, order against the reference)]: the own one from the differences of the last three
        values; the other one from the last two errors, nan if the reference is made of these very runs."""
        rows = []
        for base in self.bases(result):
            for axis in self.study.refinements():
                cases = self.curve(result, base, axis)
                lengths = [self.study.variations[axis].lengths[case.index[axis]] for case in cases]
                own = convergence.observed_order(lengths, [result.values[case] for case in cases])
                against = math.nan
                if len(cases) > 1 and result.quantity.has_reference():
                    against = convergence.order_to_limit(lengths[-2:], [result.errors[case] for case in cases[-2:]])
                rows.append((base, axis, own, against))
        return rows

    def front(self, result):
        """Cases that no other one beats in both cost and error, cheap ones first."""
        best, chosen = math.inf, []
        for case in sorted(result.errors, key=lambda case: (self.cost(case), result.errors[case])):
            if result.errors[case] < best and not result.made_reference(case):
                best = result.errors[case]
                chosen.append(case)
        return chosen

    def keeps(self, result, case, level):
        """Whether a case and all finer ones of its variant are known to be that accurate: errors that cancel by chance do not
        count."""
        refinements = self.study.refinements()
        finer = [other for other in result.errors if variant(self.study, other) == variant(self.study, case)
                 and all(other.index[axis] >= case.index[axis] for axis in refinements)]
        return not result.made_reference(case) and all(result.errors[other] + result.uncertainty() <= level for other in finer)

    def advice(self, result):
        """For each level of the study."""
        rows = []
        for level in sorted(self.study.levels, reverse=True):
            cases = [case for case in result.errors if self.keeps(result, case, level)]
            case = min(cases, key=self.cost, default=None)
            rows.append(Advice(level, case, self.budget(result, case) if case else []))
        return rows

    def cheapest(self, result, key, level):
        """The cheapest case of a variant that is as accurate as the level, as are all finer ones; None without any."""
        cases = [case for case in result.errors if variant(self.study, case) == key and self.keeps(result, case, level)]
        return min(cases, key=self.cost, default=None)

    def price_of_a_digit(self, result):
        """Factor of cost for a tenth of the error, along the advice; nan if it has fewer than two settings."""
        points = {self.cost(row.case): result.errors[row.case] for row in self.advice(result)
                  if row.case and result.errors[row.case] > 0}
        if len(points) < 2 or len(set(points.values())) < 2:
            return math.nan
        slope = numpy.polyfit(numpy.log10(list(points.values())), numpy.log10(list(points)), 1)[0]
        return 10 ** -slope

    def budget(self, result, case):
        """Shares of the error of a case, the largest first."""
        rows = []
        for axis in self.study.refinements():
            cases = self.curve(result, case, axis)
            lengths = [self.study.variations[axis].lengths[other.index[axis]] for other in cases]
            found = convergence.limit(lengths, [result.values[other] for other in cases])
            moved = convergence.norm(found.value - result.values[case])
            if found.uncertainty > 0:  # the finest value would move, too; infinity: it was not refined, nothing tells
                moved = max(moved, found.uncertainty / convergence.UNSURE)
            rows.append(Share(self.study.variations[axis].name, moved / result.scale, found.uncertainty / result.scale,
                              found.remark))
        return sorted(rows, key=lambda share: -share.size)

    def n_missing_finer(self, result, case):
        """Of the finer cases of a variant that have no value."""
        refinements = self.study.refinements()
        return sum(1 for other in self.results if other not in result.values
                   and variant(self.study, other) == variant(self.study, case)
                   and all(other.index[axis] >= case.index[axis] for axis in refinements))

    def failures(self):
        return {case: result["failure"] for case, result in self.results.items() if result["failure"]}
