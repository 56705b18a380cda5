#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The arithmetic of studies by laws that it must obey: exact limits, orders and interpolation, honest uncertainty."""
import math
import os
import sys
import unittest

import numpy

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
from study import convergence, predictions, quantities  # noqa: E402
from study.cases import make_cases  # noqa: E402
from study.columns import NotEvaluated  # noqa: E402
from study.description import Quantity, Study, Variation, flat, numbers, split, variation  # noqa: E402


def quantity(**keys):
    defaults = {field: "" for field in Quantity.__dataclass_fields__}
    defaults.update(columns=["a"], factor=1.0, evaluate="end", share_of_step=1.0, start=0.0, until=0.0, periods=0)
    return Quantity(**{**defaults, **keys})


def study(*variations, combine="all"):
    return Study("", "", "", 1, 2, 0, "core seconds", combine, [], {}, list(variations))


def refinement(name, lengths, key="Time/Step"):
    return Variation(name, "refinement", [str(length) for length in lengths], [{key: str(length)} for length in lengths],
                     list(lengths))


class Convergence(unittest.TestCase):
    def test_limit_of_a_pure_power_is_exact(self):
        for p in (1, 1.7, 2, 3):
            for lengths in ([1, 0.5, 0.25], [1, 0.7, 0.3, 0.2]):
                values = [numpy.array([[3 + 0.1 * h ** p, -1 - 2 * h ** p]]) for h in lengths]
                found = convergence.limit(lengths, values)
                self.assertAlmostEqual(found.order, p, 6)
                numpy.testing.assert_allclose(found.value, [[3, -1]], atol=1e-9)

    def test_uncertainty_holds_the_truth_where_a_second_power_disturbs(self):
        for disturbance in (-0.5, -0.2, 0.2, 0.5):
            lengths = [1, 0.5, 0.25]
            values = [numpy.array([[1 + 0.1 * h ** 2 * (1 + disturbance * h)]]) for h in lengths]
            found = convergence.limit(lengths, values)
            self.assertLessEqual(abs(found.value[0, 0] - 1), found.uncertainty)

    def test_sequences_that_do_not_converge_are_named(self):
        away = convergence.limit([1, 0.5, 0.25], [numpy.array([[x]]) for x in (1.0, 1.1, 1.3)])
        turning = convergence.limit([1, 0.5, 0.25], [numpy.array([[x]]) for x in (1.0, 1.2, 1.15)])
        self.assertIn("does not come closer", away.remark)
        self.assertIn("up and down", turning.remark)
        self.assertGreaterEqual(turning.uncertainty, 0.2)
        self.assertTrue(math.isnan(away.order))

    def test_errors_at_points_that_have_nothing_to_do_with_each_other_have_an_order(self):
        errors = numpy.array([[[1.0, 1, 1, 1]], [[1.0, -1, 1, -1]], [[1.0, 1, -1, -1]], [[1.0, -1, -1, 1]]])
        lengths = [1, 0.5, 0.25, 0.125]
        values = [7 + h ** 2 * error for h, error in zip(lengths, errors)]
        found = convergence.limit(lengths, values)
        self.assertAlmostEqual(found.order, 2, 1)
        self.assertLessEqual(convergence.norm(found.value - 7), found.uncertainty)

    def test_a_value_that_nothing_changes_is_sure(self):
        found = convergence.limit([1, 0.5], [numpy.ones((1, 1))] * 2)
        self.assertEqual((found.uncertainty, found.remark), (0, ""))


class Quantities(unittest.TestCase):
    def test_cubic_interpolation_is_exact_for_cubics_and_at_nodes(self):
        times = numpy.array([0, 0.3, 0.5, 1, 1.2, 2.0])
        values = (1 + times - 2 * times ** 2 + times ** 3)[:, None]
        at = numpy.array([0, 0.1, 0.5, 0.77, 1.9, 2])
        expected = (1 + at - 2 * at ** 2 + at ** 3)[:, None]
        numpy.testing.assert_allclose(quantities.interpolate(times, values, at), expected, atol=1e-12)

    def wave(self):
        times = numpy.linspace(0, 10, 1001)
        return {"Time": times, "a": 2 + 3 * numpy.sin(2 * math.pi * 1.7 * times + 0.4), "b": numpy.ones_like(times)}

    def value(self, **keys):
        return quantities.evaluate(quantity(**keys), self.wave()).values[0, 0]

    def test_periods_of_a_sine(self):
        self.assertAlmostEqual(self.value(evaluate="frequency"), 1.7, 4)
        self.assertAlmostEqual(self.value(evaluate="period", periods=3), 1 / 1.7, 4)
        self.assertAlmostEqual(self.value(evaluate="amplitude", periods=3), 3, 2)
        self.assertAlmostEqual(self.value(evaluate="middle", periods=3), 2, 2)
        self.assertAlmostEqual(self.value(evaluate="mean", periods=3), 2, 3)
        self.assertAlmostEqual(self.value(columns=["b"], evaluate="mean", periods=2, period_of="a"), 1, 12)

    def test_peaks_between_rows_do_not_depend_on_the_rows(self):
        for shift in (0, 0.03, 0.07):  # of rows that are 0.1 s apart or, later, 0.05 s
            times = shift + numpy.concatenate([numpy.arange(0, 1, 0.1), numpy.arange(1, 3, 0.05)])
            columns = {"Time": times, "a": 1 + 2 * numpy.sin(3 * times)}
            for evaluate, exact in (("largest", 3), ("smallest", -1), ("amplitude", 2), ("middle", 1)):
                found = quantities.evaluate(quantity(evaluate=evaluate), columns).values[0, 0]
                self.assertAlmostEqual(found, exact, 3)
        rising = {"Time": numpy.arange(3.0), "a": numpy.array([0.0, 1, 4])}
        self.assertEqual(quantities.evaluate(quantity(evaluate="largest"), rising).values[0, 0], 4)

    def test_columns_are_added_and_multiplied(self):
        self.assertAlmostEqual(self.value(columns=["b", "b"], factor=500), 1000)

    def test_values_in_the_middle_of_steps(self):
        columns = {"Time": numpy.array([0.0, 1, 3]), "a": numpy.array([7.0, 1, 2])}
        found = quantities.evaluate(quantity(evaluate="over time", share_of_step=0.5), columns)
        numpy.testing.assert_allclose(found.times, [0.5, 2])
        numpy.testing.assert_allclose(found.values[:, 0], [1, 2])

    def test_what_cannot_be_evaluated_says_why(self):
        with self.assertRaisesRegex(NotEvaluated, "no column 'c'.*similar"):
            quantities.evaluate(quantity(columns=["c"]), {"Time": numpy.zeros(1), "cc": numpy.zeros(1)})
        with self.assertRaisesRegex(NotEvaluated, "fewer than 40 whole periods"):
            quantities.evaluate(quantity(evaluate="mean", periods=40), self.wave())


class Cases(unittest.TestCase):
    def test_products_and_one_at_a_time(self):
        two = (refinement("h", [1, 0.5, 0.25]), refinement("dt", [1, 0.5]))
        self.assertEqual(len(make_cases(study(*two))), 6)
        self.assertEqual({case.index for case in make_cases(study(*two, combine="one at a time"))},
                         {(0, 0), (1, 0), (2, 0), (0, 1)})

    def test_points_fill_their_box_evenly(self):
        field = quantity(columns=[], field="velocity", lower=[0, 0], upper=[1, 2], n_points=[2, 1])
        self.assertEqual(field.points(), [[0.25, 1.0], [0.75, 1.0]])
        self.assertEqual(field.components(), [[" 0 velocity x"], [" 1 velocity x"], [" 0 velocity y"], [" 1 velocity y"]])

    def test_an_empty_value_leaves_a_key_as_the_scene_has_it(self):
        found = variation("scheme", {"Kind": "variant", "Names": "", "Lengths": "",
                                     "Settings": {"Scheme": "a | b", "Coupling": {"Fluid driven by": " | velocity"}}})
        self.assertEqual(found.settings, [{"Scheme": "a"}, {"Scheme": "b", "Coupling/Fluid driven by": "velocity"}])

    def test_texts(self):
        self.assertEqual(flat({"A": {"b": "1"}, "c": "2"}), {"A/b": "1", "c": "2"})
        self.assertEqual((split("", ";"), split("a; b", ";"), numbers("1, 2e3")), ([], ["a", "b"], [1, 2000]))

    def test_predictions_follow_a_power_law(self):
        several = study(refinement("h", [1, 0.5, 0.25, 0.125], "Domain/Cells"), refinement("dt", [1, 0.5, 0.25]))
        seconds = lambda case: 0.1 * 4 ** (1.3 * case.index[0]) * 2 ** (0.9 * case.index[1])  # noqa: E731
        known = predictions.Predictions(several)
        cases = make_cases(several)
        self.assertIsNone(known.wall_seconds(cases[0]))
        for case in cases[:6]:
            known.add(case, {"failure": "", "wall seconds": seconds(case)})
        self.assertLess(abs(math.log(known.wall_seconds(cases[-1]) / seconds(cases[-1]))), 0.2)


if __name__ == "__main__":
    unittest.main()
