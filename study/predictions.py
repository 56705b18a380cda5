# SPDX-License-Identifier: LGPL-2.1-or-later
"""How long a run of a study will take, from those that have ended."""
import math

import numpy

from study.description import numbers

GROWTH = 2.0  # a priori: seconds over the inverse of a length, of cells or elements in the plane
PARTICLES_GROWTH = 3.0  # of spacings there, with which sub-steps fall
STRENGTH = 0.05  # of what is assumed against what was seen


def assumed_growth(settings):
    """Exponent of seconds over the inverse of a length, by what is refined with it: tolerances cost next to nothing."""
    cells = [float(len(numbers(text))) for key, text in settings.items() if key.endswith("/Cells")]
    others = [GROWTH for key in settings if key.startswith("Domain/Planes") or "mesh" in key.lower()]
    steps = [1.0 for key in settings if key in ("Time/Step", "Particles/Sub-steps/Largest")]
    spacings = [PARTICLES_GROWTH for key in settings if key == "Particles/Spacing"]
    return max(cells + others, default=0.0) + max(steps, default=0.0) * (not spacings) + max(spacings, default=0.0)


class Predictions:
    """log(seconds) = a + sum_k b_k log(1/length_k) + c(variant), by least squares with weak assumptions on b and c."""

    def __init__(self, study):
        self.study, self.rows, self.seen = study, [], []

    def features(self, case):
        result = [1.0]
        for variation, position in zip(self.study.variations, case.index):
            if variation.lengths:
                result.append(math.log(variation.lengths[0] / variation.lengths[position]))
            else:
                result += [float(position == k) for k in range(len(variation.names))]
        return result

    def assumed(self):
        """Exponents before anything was seen, in the order of features()."""
        result = [0.0]
        for variation in self.study.variations:
            if variation.lengths:
                result.append(assumed_growth(variation.settings[0]) if variation.is_refinement() else 0.0)
            else:
                result += [0.0] * len(variation.names)
        return numpy.array(result)

    def add(self, case, result):
        if not result["failure"]:
            self.rows.append(self.features(case))
            self.seen.append(math.log(max(result["elapsed"], 1e-3)))

    def wall_seconds(self, case):
        """Expected; None before anything was seen."""
        if not self.rows:
            return None
        rows, assumed = numpy.array(self.rows), self.assumed()
        weights = numpy.full(len(assumed), STRENGTH)
        weights[0] = 0
        normal = rows.T @ rows + numpy.diag(weights) + 1e-9 * numpy.eye(len(assumed))
        deviation = numpy.linalg.solve(normal, rows.T @ (numpy.array(self.seen) - rows @ assumed))
        return math.exp(numpy.array(self.features(case)) @ (assumed + deviation))
