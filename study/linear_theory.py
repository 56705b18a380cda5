# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where along the last range of a map of stability linear theory foretells that time splitting begins to be unstable: by
runs of one short step, at whose start the program finds the growth of a linearised step."""
import dataclasses
import math
import os

from study.campaign import Campaign

SETTINGS = {"Output/Stability of splitting": "true", "Time/End": "1e-6"}  # the step that counts is Time/Step
GROWS = 1.001  # a step; what does not grow may have an eigenvalue that is next to 1
WITHIN = 1.02  # the factor between the neighbours of a boundary


class LinearTheory:
    """Foretold boundaries of a map, [(line, number)]."""

    def __init__(self, found):
        self.found = found
        self.study = dataclasses.replace(found.study, settings={**found.study.settings, **SETTINGS}, repeat_below=0.0)
        self.results = {}

    def grows(self, case):
        """None if nothing is foretold: of schemes that do not split, or where the run fails."""
        growth = self.results[case].get("foretold growth")
        return None if growth is None else growth > GROWS

    def pairs(self):
        """[(line, one, other)] of neighbours of which one grows and the other one does not."""
        lines = {}
        for case in sorted(self.results, key=self.found.number):
            if self.grows(case) is not None:
                lines.setdefault(self.found.line(case), []).append(case)
        return [(line, one, other) for line, cases in lines.items() for one, other in zip(cases, cases[1:])
                if self.grows(one) != self.grows(other)]

    def carry_out(self, cases):
        """From these cases on, as many between them as it takes."""
        while cases:
            campaign = Campaign(self.found.program, self.study, [*self.results, *cases],
                                os.path.join(self.found.folder, "linear theory"), self.found.jobs, self.found.within)
            self.results = campaign.carry_out()
            middles = [one.with_value(self.found.axis, self.found.position_between(one, other)) for _, one, other in self.pairs()
                       if self.found.number(other) > WITHIN * self.found.number(one)]
            cases = [case for case in middles if case not in self.results]
        return self

    def boundaries(self):
        return [(line, math.sqrt(self.found.number(one) * self.found.number(other))) for line, one, other in self.pairs()]
