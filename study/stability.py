# SPDX-License-Identifier: LGPL-2.1-or-later
"""Maps of stability: where along the ranges of a study runs are stable, by their own verdicts; boundaries by bisection."""
import itertools
import math
import time
from dataclasses import dataclass

from study import description
from study.campaign import Campaign, only_one
from study.cases import Case
from study.linear_theory import LinearTheory

VERDICTS = ("stable", "undecided", "growing", "failed")


def verdict(result):
    """One of VERDICTS; "" of a run that was left out or says nothing."""
    if result.get("left out"):
        return ""
    if result["failure"] and not result.get("stopped"):
        # A full disk, too little memory or a scene that is refused say nothing of stability.
        code = result.get("exit code")
        return "failed" if code == 3 or (code == 2 and "reached" in result) else ""
    return result.get("verdict", "")


@dataclass
class Boundary:
    """Between two neighbours along the last range, of which one is stable and the other one is not, or not surely."""
    line: tuple  # positions in all other variations
    stable: float
    unstable: float
    verdict: str  # of the unstable one

    def value(self):
        return math.sqrt(self.stable * self.unstable)


class StabilityMap:
    """Runs of a study with ranges. Along the last range more values are tried between neighbours with different verdicts."""

    unevaluated, quantities = (), ()

    def __init__(self, program, study, folder, jobs, within):
        self.program, self.study, self.folder, self.jobs = program, study, folder, jobs
        self.end = None if within is None else time.monotonic() + within
        self.axis = study.ranges()[-1]
        self.results, self.n_first = {}, 0
        self.foretold = []  # boundaries by linear theory, [(line, number)]

    @property
    def within(self):
        """Seconds that are left for all rounds of bisection together; None: no limit."""
        return None if self.end is None else max(0.0, self.end - time.monotonic())

    def carry_out(self):
        sizes = [range(len(variation.names)) for variation in self.study.variations]
        cases = first = [Case(index) for index in itertools.product(*sizes)]
        self.n_first = len(cases)
        while cases:
            campaign = Campaign(self.program, self.study, [*self.results, *cases], self.folder, self.jobs, self.within)
            self.results = campaign.carry_out()
            cases = [case for case in self.middles() if case not in self.results]  # one without a verdict has no half
        if self.study.linear_theory:
            self.foretold = LinearTheory(self).carry_out(first).boundaries()

    def number(self, case):
        """Along the last range."""
        return self.study.variations[self.axis].lengths[case.index[self.axis]]

    def line(self, case):
        """Positions of a case in all variations but the last range."""
        return case.index[:self.axis] + case.index[self.axis + 1:]

    def lines(self):
        """{positions in all other variations: cases by rising numbers along the last range}, of runs that have a verdict."""
        found = {}
        for case in sorted(self.results, key=self.number):
            if verdict(self.results[case]):
                found.setdefault(self.line(case), []).append(case)
        return found

    def changes(self):
        """[(line, stable neighbour, unstable neighbour)]."""
        found = []
        for line, cases in self.lines().items():
            for pair in itertools.pairwise(cases):
                stable = [verdict(self.results[case]) == "stable" for case in pair]
                if stable[0] != stable[1]:
                    found.append((line, *(pair if stable[0] else pair[::-1])))
        return found

    def middles(self):
        """Cases between neighbours that are too far from each other."""
        result = []
        for _, stable, unstable in self.changes():
            low, high = sorted((self.number(stable), self.number(unstable)))
            if high > self.study.boundary * low:
                result.append(stable.with_value(self.axis, self.position_between(stable, unstable)))
        return result

    def position_between(self, one, other):
        """In the last range, of the geometric means of the numbers of two cases, which are added to it."""
        variation = self.study.variations[self.axis]
        middle = math.sqrt(self.number(one) * self.number(other))
        for position, length in enumerate(variation.lengths):
            if abs(length / middle - 1) < 1e-9:
                return position
        variation.settings.append({key: f"{middle:.10g}" for key in variation.settings[0]})
        variation.names.append(f"{middle:.4g}")
        variation.lengths.append(middle)
        return len(variation.lengths) - 1

    def boundaries(self):
        return [Boundary(line, self.number(stable), self.number(unstable), verdict(self.results[unstable]))
                for line, stable, unstable in self.changes()]

    def names_of(self, line):
        """Of the values of a line."""
        others = [variation for k, variation in enumerate(self.study.variations) if k != self.axis]
        return [variation.names[position] for variation, position in zip(others, line)]


def of_file(program, file, folder, jobs, within=None):
    """The map of a study's file."""
    found = StabilityMap(program, description.read(program, file), folder, jobs, within)
    with only_one(folder):
        found.carry_out()
    return found
