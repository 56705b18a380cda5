#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The arithmetic of studies by laws that it must obey: exact limits, orders and interpolation, honest uncertainty."""
import contextlib
import dataclasses
import io
import json
import math
import os
import sys
import tempfile
import time
import unittest
import unittest.mock

import numpy

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
from benchmarks import estimates, hard_case_laws  # noqa: E402
from study import analysis, columns, convergence, description, page, predictions, quantities, references, report, runs  # noqa: E402
from study import orders, plots, scene_files, stability, tables  # noqa: E402
from study.accuracy import default_column  # noqa: E402
from study.campaign import readable  # noqa: E402
from study.cases import Case, make_cases, of_scene, ranks  # noqa: E402
from study.columns import NotEvaluated  # noqa: E402
from study.description import Quantity, Study, Variation, check_own_keys, flat, numbers, split, variation  # noqa: E402
from study.error_model import ErrorModel, Part  # noqa: E402
from study.knobs import Knob, common_length, knobs_of  # noqa: E402
from study.level import Level, coarser_neighbour  # noqa: E402
from study.pilot import Destination, Pilot, Refused, Setting, quantity_of  # noqa: E402
from study.search import Search, cheapest, known_level, with_room  # noqa: E402


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

    def test_a_large_difference_before_a_small_one_is_not_forgotten(self):
        unequal = convergence.limit([1, 0.5, 0.45], [numpy.array([[x]]) for x in (0.0, 1.0, 1.9)])
        self.assertIn("does not come closer", unequal.remark)
        self.assertAlmostEqual(unequal.uncertainty, 3.0)
        chance = convergence.limit([1, 0.5, 0.25, 0.125], [numpy.array([[x]]) for x in (1.0, 1e-3, 1e-6, 1e-9)])
        self.assertAlmostEqual(chance.uncertainty, 3 * (1e-6 - 1e-9), 12)

    def test_the_truth_is_within_the_uncertainty_of_sequences_that_are_not_asymptotic_yet(self):
        # Drag and lift of the cylinder of DFG 2D-1 with 10, 20 and 40 cells across; the limits are in tests/reference.
        for values, truth in (((5.41379, 5.58084, 5.586), 5.57953), ((-0.256, 0.00936, 0.01010), 0.010619)):
            found = convergence.limit([4, 2, 1], [numpy.array([[value]]) for value in values])
            self.assertLessEqual(abs(found.value[0, 0] - truth), found.uncertainty)
            self.assertIn("chance", found.remark)

    def test_two_equal_values_after_others_are_not_sure(self):
        found = convergence.limit([4, 2, 1], [numpy.array([[value]]) for value in (1, 1.2, 1.2)])
        self.assertGreaterEqual(found.uncertainty, 0.2)
        self.assertIn("the same", found.remark)

    def test_two_values_with_a_large_ratio_assume_no_more_than_others(self):
        for order in (0.67, 1, 2):
            values = [numpy.array([[1 + tolerance ** order]]) for tolerance in (1e-2, 1e-4)]
            found = convergence.limit([1e-2, 1e-4], values)
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

    def test_periods_of_a_vector_are_those_of_the_component_that_moves_most(self):
        self.assertAlmostEqual(self.value(columns=["b", "a"], is_vector=True, evaluate="frequency"), 1.7, 4)

    def test_vectors_are_known_by_their_components(self):
        wave = self.wave()
        rows = {"Time": wave["Time"], "tip displacement x": 0 * wave["a"], "tip displacement y": wave["a"], "tip pressure": wave["b"]}
        self.assertEqual(default_column(rows), "tip displacement")
        for name, columns_of in (("tip displacement", ["tip displacement x", "tip displacement y"]), ("tip pressure", ["tip pressure"]),
                                 ("tip displacement y", ["tip displacement y"]), ("unknown", ["unknown"])):
            self.assertEqual(quantity_of(name, "end", rows).columns, columns_of)
        found = quantities.evaluate(quantity_of("tip displacement", "end", rows), rows)
        numpy.testing.assert_array_equal(found.values, [[0, wave["a"][-1]]])

    def test_peaks_between_rows_do_not_depend_on_the_rows(self):
        for shift in (0, 0.03, 0.07):  # of rows that are 0.1 s apart or, later, 0.05 s
            times = shift + numpy.concatenate([numpy.arange(0, 1, 0.1), numpy.arange(1, 3, 0.05)])
            columns = {"Time": times, "a": 1 + 2 * numpy.sin(3 * times)}
            for evaluate, exact in (("largest", 3), ("smallest", -1), ("amplitude", 2), ("middle", 1)):
                found = quantities.evaluate(quantity(evaluate=evaluate), columns).values[0, 0]
                self.assertAlmostEqual(found, exact, 3)
        rising = {"Time": numpy.arange(3.0), "a": numpy.array([0.0, 1, 4])}
        self.assertEqual(quantities.evaluate(quantity(evaluate="largest"), rising).values[0, 0], 4)

    def test_extremes_of_rows_that_are_unevenly_apart(self):
        times = numpy.array([0, 0.2, 0.5, 0.6, 1.0, 1.3])
        ((at,), (value,)) = hard_case_laws.extremes(times, 1 - (times - 0.53) ** 2, 0.01)
        self.assertAlmostEqual(at, 0.53, 12)
        self.assertAlmostEqual(value, 1.0, 12)

    def test_columns_are_added_and_multiplied(self):
        self.assertAlmostEqual(self.value(columns=["b", "b"], factor=500), 1000)

    def test_when_the_largest_value_is_reached(self):
        times = numpy.array([0, 0.4, 1.1, 1.5, 2.3])
        found = {"Time": times, "a": 3 - 2 * (times - 1.2) ** 2}
        for evaluate, exact in (("time of largest", 1.2), ("largest", 3)):  # of a parabola between rows
            self.assertAlmostEqual(quantities.evaluate(quantity(evaluate=evaluate), found).values[0, 0], exact, 12)

    def test_windows_begin_and_end_between_rows(self):
        for step in (0.1, 0.07, 0.013):
            times = numpy.arange(0, 1.2, step)
            found = {"Time": times, "a": times ** 3}
            mean = quantities.evaluate(quantity(evaluate="mean", start=0.33, until=1.0), found).values[0, 0]
            self.assertAlmostEqual(mean, (1 - 0.33 ** 4) / 4 / 0.67, delta=step ** 2)
            self.assertAlmostEqual(quantities.evaluate(quantity(until=0.77), found).values[0, 0], 0.77 ** 3, 9)

    def test_values_in_the_middle_of_steps(self):
        columns = {"Time": numpy.array([0.0, 1, 3]), "a": numpy.array([7.0, 1, 2])}
        found = quantities.evaluate(quantity(evaluate="over time", share_of_step=0.5), columns)
        numpy.testing.assert_allclose(found.times, [0.5, 2])
        numpy.testing.assert_allclose(found.values[:, 0], [1, 2])

    def test_values_within_steps_are_not_taken_where_they_belong_to_other_times_with_each_step(self):
        columns = {"Time": numpy.array([0.0, 1, 2, 3]), "a": numpy.array([7.0, 1, 2, 3])}
        for until in (0.0, 2.9):
            with self.assertRaisesRegex(quantities.NotEvaluated, "depends on the step"):
                quantities.evaluate(quantity(share_of_step=0.5, until=until), columns)
        self.assertEqual(quantities.evaluate(quantity(share_of_step=0.5, until=2.5), columns).values[0, 0], 3)
        with self.assertRaisesRegex(quantities.NotEvaluated, "Rate"):
            quantities.evaluate(quantity(share_of_step=0.5, rate=True, evaluate="over time"), columns)

    def test_rates_are_of_second_order_and_exact_for_parabolas(self):
        times = numpy.array([0, 0.4, 1.1, 1.5, 2.3])
        parabola = {"Time": times, "a": 3 + times - 2 * times ** 2, "b": times ** 2}
        found = quantities.evaluate(quantity(columns=["a", "b"], factor=2.0, rate=True, evaluate="over time"), parabola)
        numpy.testing.assert_allclose(found.times, times)
        numpy.testing.assert_allclose(found.values[:, 0], 2 - 4 * times, atol=1e-12)
        errors = []
        for step in (0.02, 0.01):
            times = numpy.arange(0, 1 + step / 2, step)
            found = quantities.evaluate(quantity(rate=True, evaluate="over time"),
                                        {"Time": times, "a": numpy.sin(3 * times)})
            errors.append(numpy.abs(found.values[:, 0] - 3 * numpy.cos(3 * times)).max())
        self.assertAlmostEqual(math.log2(errors[0] / errors[1]), 2, 1)

    def test_rates_over_a_time_are_means_that_no_step_changes(self):
        for step in (0.1, 0.05, 0.03):
            times = numpy.arange(0, 2, step)
            found = quantities.evaluate(quantity(rate=True, rate_over=0.4, evaluate="over time", start=0.5, until=1.5),
                                        {"Time": times, "a": times ** 3})
            inside = found.values[1:-1, 0]
            numpy.testing.assert_allclose(inside, 3 * found.times[1:-1] ** 2 + 0.2 ** 2, atol=1e-10)
            ends = quantities.evaluate(quantity(rate=True, rate_over=0.4, evaluate="over time"),
                                       {"Time": times, "a": times ** 2})
            numpy.testing.assert_allclose(ends.values[:, 0], 2 * times, atol=1e-10)

    def test_rates_are_taken_before_the_window(self):
        times = numpy.linspace(0, 1, 11)
        kink = {"Time": times, "a": numpy.maximum(0, times - 0.5)}
        found = quantities.evaluate(quantity(rate=True, evaluate="over time", start=0.5), kink)
        self.assertAlmostEqual(found.values[0, 0], 0.5, 12)
        with self.assertRaisesRegex(NotEvaluated, "a rate needs three rows"):
            quantities.evaluate(quantity(rate=True), {name: values[:2] for name, values in kink.items()})

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

    def variants(self):
        """Two ways to choose steps, over a refinement of both."""
        ways = Variation("way", "variant", ["constant", "tolerance"], [
            {"Time/Tolerance": "", "Time/Step": "as is", "Ranks": "1"},
            {"Time/Tolerance": "as is", "Time/Step": "0.1", "Ranks": "2", "Quantities/q/Share of step": "0.5"}], [])
        both = Variation("both", "refinement", ["1", "2"], [{"Time/Step": "1/20", "Time/Tolerance": "0.1"},
                                                            {"Time/Step": "1/40", "Time/Tolerance": "0.03"}], [2, 1])
        return study(both, ways)

    def test_later_variations_override_earlier_ones_and_leave_as_it_is_what_they_do_not_change(self):
        several = self.variants()
        found = {case.index: case for case in make_cases(several)}
        self.assertEqual(of_scene(found[1, 0].settings(several)), {"Time/Step": "1/40", "Time/Tolerance": ""})
        self.assertEqual(of_scene(found[1, 1].settings(several)), {"Time/Step": "0.1", "Time/Tolerance": "0.03"})
        self.assertEqual([ranks(several, found[0, k]) for k in (0, 1)], [1, 2])

    def test_variations_change_how_quantities_are_evaluated(self):
        several = self.variants()
        section = {key: "" for key in ("Columns", "Unit", "Evaluate", "Period of", "Field", "Body", "Lower corner",
                                       "Upper corner", "Points", "Reference", "Reference file", "Reference column",
                                       "Reference row", "Reference times")}
        section.update(dict.fromkeys(("Factor", "Share of step", "From", "Until", "Periods", "Reference factor", "Scale"),
                                     "1"))
        found = quantity(name="q", section=section, folder="")
        several.quantities.append(found)
        check_own_keys(several)
        shares = [found.in_case(case.settings(several)).share_of_step for case in make_cases(several)]
        self.assertEqual(shares, [1, 0.5, 1, 0.5])
        several.settings["Quantities/p/Factor"] = "2"
        with self.assertRaisesRegex(SystemExit, "must not change 'Quantities/p/Factor'"):
            check_own_keys(several)
        for key, wrong in (("Factor", "two"), ("Rate", "yes")):
            several.settings = {f"Quantities/q/{key}": wrong}
            with self.assertRaisesRegex(SystemExit, wrong):
                check_own_keys(several)

    def test_values_at_the_end_of_steps_of_several_lengths_belong_to_one_time(self):
        for until, is_refused in ((0.0, True), (0.9, False)):
            several = study(refinement("h", [0.2, 0.1]))
            several.quantities.append(quantity(name="q", evaluate="end", share_of_step=0.5, until=until))
            if is_refused:
                with self.assertRaisesRegex(SystemExit, "give 'Until'"):
                    check_own_keys(several)
            else:
                check_own_keys(several)

    def test_points_fill_their_box_evenly(self):
        field = quantity(columns=[], field="velocity", lower=[0, 0], upper=[1, 2], n_points=[2, 1])
        self.assertEqual(field.points(), [[0.25, 1.0], [0.75, 1.0]])
        self.assertEqual(field.components(), [[" 0 velocity x"], [" 1 velocity x"], [" 0 velocity y"], [" 1 velocity y"]])

    def test_values_that_are_empty_or_as_is(self):
        found = variation("scheme", {"Kind": "variant", "Names": "", "Lengths": "",
                                     "Settings": {"Scheme": "as is | b", "Coupling": {"Fluid driven by": " | velocity"}}})
        first, second = (Case((k,)).settings(study(found)) for k in (0, 1))
        self.assertEqual(first, {"Coupling/Fluid driven by": ""})
        self.assertEqual(second, {"Scheme": "b", "Coupling/Fluid driven by": "velocity"})

    def test_texts(self):
        self.assertEqual(flat({"A": {"b": "1"}, "c": "2"}), {"A/b": "1", "c": "2"})
        self.assertEqual((split("", ";"), split("a; b", ";"), numbers("1, 2e3")), ([], ["a", "b"], [1, 2000]))

    def test_scenes_without_keys(self):
        with tempfile.TemporaryDirectory() as folder:
            def write(name, text):
                with open(os.path.join(folder, name), "w") as file:
                    file.write(text)
            write("part.inc", "subsection B # set\n  set Theta = 1\nend\nset Theta = 2 # set anew below\nset End = 2 # kept\n")
            write("titled.prm", "set Title = run \\# 1\nsubsection Time\n  set End = 1\nend\nset Name = a\\\\\nset B = 2\n")
            self.assertEqual(scene_files.without(os.path.join(folder, "titled.prm"), {"Time/End", "B"}),
                             "set Title = run \\# 1\nsubsection Time\nend\nset Name = a\\\\\n")
            write("scene.prm", "set Gamma = 3\nsubsection Time\n  set Gamma = 1 + \\\n  2\n  set Theta= 4\n"
                               "  include part.inc\nend")
            self.assertEqual(scene_files.without(os.path.join(folder, "scene.prm"), {"Time/Gamma", "Time/B/Theta"}),
                             "set Gamma = 3\nsubsection Time\n  set Theta= 4\nsubsection B # set\nend\n"
                             "set End = 2 # kept\nend\n")

    def test_phases_of_a_run(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "timing")
            self.assertEqual(columns.phases(path), {})
            with open(path, "w") as file:
                file.write("phase  calls  seconds  share\nsolid         3   1.50  75.0\n  solve it    6   0.50  25.0\n")
            self.assertEqual(columns.phases(path), {"solid": 1.5, "solid / solve it": 0.5})
            self.assertEqual(columns.timing(path), {"solid": (3, 1.5), "solid / solve it": (6, 0.5)})

    def test_reasons_are_told_without_the_step(self):
        step = "step 6, which begins at 0.01 s: a step of 0.002 s failed, the last one of 0.002 s: "
        self.assertEqual(tables.reason({"failure": step + "Newton's method does not converge. Norms: 1 2"}),
                         "Newton's method does not converge")
        several = step.replace("s failed", "s and 6 shorter one(s) failed")
        self.assertEqual(tables.reason({"failure": several + "folder/scene.prm: at 1e-05 s too much flows out: see there"}),
                         "too much flows out")
        passes = "step 9, which begins at 0.3 s: /a/scene.prm: by 0.4 s body 'a' passes the wall at side 'top' of the domain, at (1, 2). Try: b"
        self.assertEqual(tables.reason({"failure": passes}), "body 'a' passes the wall at side 'top' of the domain")
        self.assertEqual(tables.brief({"failure": step + "it is wrong", "reached": 0.01}), "stops at 0.01 s")
        self.assertEqual(tables.brief({"failure": "no such key. Did you mean another?"}),
                         "no such key. Did you mean another?")

    def test_predictions_follow_a_power_law(self):
        several = study(refinement("h", [1, 0.5, 0.25, 0.125], "Domain/Cells"), refinement("dt", [1, 0.5, 0.25]))
        seconds = lambda case: 0.1 * 4 ** (1.3 * case.index[0]) * 2 ** (0.9 * case.index[1])  # noqa: E731
        known = predictions.Predictions(several)
        cases = make_cases(several)
        self.assertIsNone(known.wall_seconds(cases[0]))
        for case in cases[:6]:
            known.add(case, {"failure": "", "elapsed": seconds(case)})
        self.assertLess(abs(math.log(known.wall_seconds(cases[-1]) / seconds(cases[-1]))), 0.2)

    def test_predictions_after_one_run_know_what_is_refined(self):
        lengths = [4, 2, 1]

        def ratio(*keys):
            """Of the seconds of two lengths of which one is half of the other."""
            paths = Variation("h", "refinement", ["a", "b", "c"], [dict(keys) for _ in lengths], lengths)
            known = predictions.Predictions(study(paths))
            cases = make_cases(known.study)
            known.add(cases[0], {"failure": "", "elapsed": 0.3})
            return known.wall_seconds(cases[1]) / known.wall_seconds(cases[0])

        for keys, expected in (([("Coupling/Tolerance", "1e-6")], 1), ([("Time/Step", "0.1")], 2), ([("Domain/Cells", "8, 8")], 4),
                               ([("Domain/Cells", "8, 8, 8"), ("Bodies/a/Cells", "2, 2, 2")], 8),
                               ([("Domain/Cells", "8, 8"), ("Time/Step", "0.1")], 8), ([("Particles/Spacing", "0.1")], 8)):
            self.assertAlmostEqual(ratio(*keys), expected, 6)


class Repetitions(unittest.TestCase):
    def test_all_times_are_those_of_the_repetition_of_median_cost(self):
        for costs, middle in (([3, 1, 2], 2), ([1, 2, 3], 2), ([5, 1, 9], 5)):
            left = list(costs)

            def once(_program, _study, _case, folder, _limit, left=left):
                os.makedirs(os.path.join(folder, "run"))
                cost = left.pop(0)
                with open(os.path.join(folder, "run", "timing"), "w") as file:
                    file.write(str(cost))
                return {"failure": "", "stopped": False, "exit code": 0, "core seconds": cost, "wall seconds": 10 * cost}

            with tempfile.TemporaryDirectory() as above, unittest.mock.patch.object(runs, "once", once):
                folder = os.path.join(above, "case")
                long_enough = dataclasses.replace(study(refinement("step", [1])), repeat_below=100.0)
                result = runs.run("", long_enough, Case((0,)), folder, 0)
                self.assertEqual((result["core seconds"], result["wall seconds"], result["repetitions"]),
                                 (middle, 10 * middle, 3))
                with open(os.path.join(folder, "timing")) as file:
                    self.assertEqual(file.read(), str(middle))
                self.assertEqual(os.listdir(above), ["case"])


class FakePilot:
    """Runs whose errors are powers of the factors, of a value over time, and which cost what is expected."""

    def __init__(self, sizes, orders, deadline=None, noise=0.0, steep=1.0, overhead=0.0):
        self.steep, self.overhead = steep, overhead  # factor of the exponents of cost; what does not grow
        self.sizes, self.orders, self.deadline, self.noise = sizes, orders, deadline, noise
        self.times_of_rows, self.values, self.costs, self.failures = numpy.linspace(0, 1, 11), {}, {}, {}
        self.study, self.quantity = study(), quantity(evaluate="over time")
        self.too_coarse, self.start = {}, 0.0

    def exact(self):
        return numpy.cos(self.times_of_rows)

    def error(self, setting):
        waves = (numpy.cos(self.times_of_rows), numpy.sin(2 * self.times_of_rows), self.times_of_rows)
        parts = sum(size * wave * factor ** -order for size, wave, factor, order in
                    zip(self.sizes, waves, setting.factors, self.orders))
        return parts + self.noise * numpy.cos(100 * sum(setting.factors) * self.times_of_rows)

    def run(self, setting):
        self.costs[setting] = self.overhead + math.prod(factor ** (self.steep * knob.growth)
                                                        for knob, factor in zip(setting.knobs, setting.factors))
        self.values[setting] = quantities.Values(self.times_of_rows, (self.exact() + self.error(setting))[:, None])
        return self.values[setting]

    def run_with_outputs(self, setting):
        return self.run(setting)

    def run_all(self, settings):
        for setting in settings:
            self.run(setting)

    def times(self, _):
        return self.times_of_rows

    def compare(self, settings, _):
        return [self.values[setting].values for setting in settings]

    def seconds(self, setting, growth):
        return self.start + growth * self.costs[setting]

    def true_error(self, setting):
        return convergence.norm(self.error(setting)) / convergence.norm(self.exact())


class PilotOfShortSteps(FakePilot):
    """Runs that fail with steps that are longer than the scene's, and an error of both things together."""

    cross = 0.0

    def run(self, setting):
        if setting.factors[0] < 0.9:
            self.costs[setting], self.failures[setting] = 1e-3, "the step is too long"
            return None
        return super().run(setting)

    def error(self, setting):
        step, cells = setting.factors
        return super().error(setting) + self.cross * self.times_of_rows ** 3 * step ** -2.0 / cells


class Results(unittest.TestCase):
    """What an analysis says of runs whose values are given."""

    def analyse(self, values, *variations, missing=(), levels=(0.1, 0.05, 0.02, 0.01), **keys):
        several = study(*variations)
        several.levels = list(levels)
        several.quantities.append(quantity(name="q", reference=[], field="", scale=0, **keys))
        cases = make_cases(several)
        results = {case: {"failure": "left out" if case.index in missing else "", "core seconds": 1.0 + sum(case.index),
                          "left out": case.index in missing} for case in cases}
        columns_of = {case: {"Time": numpy.array([0.0, 1]), "a": numpy.array([0.0, values(*case.index)])} for case in cases}
        before, analysis.Analysis.read = analysis.Analysis.read, staticmethod(lambda case: columns_of[case])
        try:
            return analysis.Analysis("", several, results, {case: case for case in cases})
        finally:
            analysis.Analysis.read = before

    def test_a_missing_finest_run_takes_away_no_more_than_itself(self):
        value = lambda i, j: 1 + 0.04 / 4 ** i + 0.02 / 4 ** j  # noqa: E731
        for missing in ([], [(2, 2)], [(2, 2), (2, 1)]):
            found = self.analyse(value, refinement("h", [4, 2, 1]), refinement("dt", [4, 2, 1]), missing=missing)
            (result,) = found.quantities
            self.assertLessEqual(abs(result.reference.values[0, 0] - 1), result.reference.uncertainty + 1e-12)
            self.assertEqual(any("is missing" in each for each in result.reference.warnings), bool(missing))
            self.assertIn("missing" if missing else "q", "\n".join(tables.section(found, result)))

    def test_what_a_refinement_does_not_change_is_no_reference_for_what_it_does(self):
        variants = Variation("kind", "variant", ["fixed", "own"], [{"k": "1"}, {"k": "2"}], [])
        value = lambda kind, i: 1.2 if kind == 0 else 1 + 0.2 / 4 ** i  # noqa: E731
        (result,) = self.analyse(value, variants, refinement("dt", [4, 2, 1])).quantities
        self.assertIn("own", result.reference.source)
        self.assertAlmostEqual(result.reference.values[0, 0], 1)

    def test_a_reference_is_no_surer_than_variants_agree(self):
        variants = Variation("kind", "variant", ["one", "other"], [{"k": "1"}, {"k": "2"}], [])
        for limit in (1.3, 1.0):  # of the other one, whose values change less
            value = lambda kind, i: (limit + 0.02 / 4 ** i if kind else 1 + 0.2 / 4 ** i)  # noqa: E731
            (result,) = self.analyse(value, variants, refinement("h", [4, 2, 1])).quantities
            self.assertEqual(any("lead elsewhere" in each for each in result.reference.warnings), limit != 1.0)
            for truth in (1.0, limit):
                self.assertLessEqual(abs(result.reference.values[0, 0] - truth), result.reference.uncertainty + 1e-12)

    def test_a_single_run_knows_nothing_of_its_error(self):
        found = self.analyse(lambda i: 1.0 + i, refinement("dt", [4, 2, 1]), missing=[(0,), (1,)])
        (result,) = found.quantities
        self.assertEqual(result.uncertainty(), math.inf)
        self.assertTrue(all(row.case is None for row in found.advice(result)))
        self.assertIn("is the reference", "\n".join(tables.errors(found, result)))
        json.dumps(tables.data_of(found), allow_nan=False)
        self.assertEqual(tables.records(found)[2]["error of q"], "")

    def test_two_values_have_a_page(self):
        found = self.analyse(lambda i: (1.014, 1.0)[i], refinement("dt", [2, 1]))
        (result,) = found.quantities
        self.assertTrue(math.isnan(found.price_of_a_digit(result)))
        self.assertIn("no order is known", report.text(found))

    def test_where_nothing_is_refined_nothing_is_known(self):
        variants = Variation("kind", "variant", ["one", "other"], [{"k": "1"}, {"k": "2"}], [])
        found = self.analyse(lambda kind: 1 + 0.3 * kind, variants)
        (result,) = found.quantities
        self.assertEqual(result.uncertainty(), math.inf)
        self.assertTrue(any("nothing is refined" in each for each in result.reference.warnings))
        self.assertTrue(all(row.case is None for row in found.advice(result)))

    def test_references_that_do_not_fit_say_why(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "table.csv")
            with open(path, "w") as file:
                file.write("case,drag\na,1.5\nb,\n")
            of_row = lambda row: quantity(name="q", reference=[], reference_file=path, reference_column="drag",  # noqa: E731
                                          reference_row={"case": row}, reference_factor=1.0)
            for row, width, reason in (("b", 1, "no number"), ("a", 8, "1 component"), ("c", 1, "no such row")):
                with self.assertRaisesRegex(references.NoReference, reason):
                    references.make("", study(), of_row(row), numpy.zeros(1), {Case((0,)): numpy.zeros((1, width))})
            made = references.make("", study(), of_row("a"), numpy.zeros(1), {Case((0,)): numpy.zeros((1, 1))})
            self.assertEqual(made.values[0, 0], 1.5)
        with self.assertRaisesRegex(SystemExit, "column = value"):
            description.row("400")

    def test_titles_and_messages_may_have_any_sign(self):
        several = refinement("h", [4, 2, 1])
        found = self.analyse(lambda i: 1 + 0.2 / 4 ** i, several)
        found.study.title = r"Costs of $\nothing$ and $5"
        found.results[Case((0,))]["failure"] = "max |v| is too large"
        (result,) = found.quantities
        result.errors.pop(Case((0,)), None)
        with tempfile.TemporaryDirectory() as folder:
            plots.work_precision(found, result, os.path.join(folder, "picture.svg"))
            with open(os.path.join(folder, "picture.svg")) as file:
                self.assertIn(r"\nothing", file.read())
        lines = [line for line in tables.errors(found, result) if line]
        self.assertIn(r"max \|v\| is too large", "".join(lines))
        self.assertEqual({page.cells(line, "td").count("<td>") for line in lines if "---" not in line}, {4})
        self.assertIn("max |v| is", page.cells(lines[2], "td"))

    def test_pictures_have_identifiers_of_any_name(self):
        self.assertIn('href="#2nd_peak_a"', page.inline_svg('<svg><g id="a"/><use href="#a"/></svg>', "2nd peak"))

    def test_orders_of_errors_against_what_is_exact(self):
        for exact, shown in (("", math.nan), ("1", 2.0)):
            found = self.analyse(lambda i: 1 + 0.2 / 4 ** i, refinement("dt", [4, 2, 1]))
            (result,) = found.quantities
            result.quantity.reference = [exact] if exact else []
            result.errors = {case: 0.2 / 4 ** case.index[0] for case in result.errors}
            ((_, _, own, against),) = found.orders(result)
            self.assertAlmostEqual(own, 2)
            numpy.testing.assert_allclose(against, shown)


class FakeCampaign:
    """Runs that are stable below 3, and of which those next to it, which bisection asks for, have no verdict."""

    made = []

    def __init__(self, _, of_study, cases, folder, jobs, within):
        self.study, self.cases = of_study, cases
        FakeCampaign.made.append((len(cases), within))

    def result(self, case):
        number = self.study.variations[0].lengths[case.index[0]]
        verdict = "stable" if number < 3 else "growing"
        return {"failure": "", "stopped": 1.5 < number < 8, "verdict": "" if 1.5 < number < 8 else verdict}

    def carry_out(self):
        return {case: self.result(case) for case in self.cases}


class Maps(unittest.TestCase):
    def test_bisection_ends_at_runs_without_a_verdict_and_within_the_time(self):
        along = Variation("h", "range", ["1", "10"], [{"Time/Step": "1"}, {"Time/Step": "10"}], [1.0, 10.0])
        FakeCampaign.made = []
        with unittest.mock.patch.object(stability, "Campaign", FakeCampaign):
            found = stability.StabilityMap("", study(along), "", 1, 1000.0)
            found.carry_out()
        self.assertEqual([count for count, _ in FakeCampaign.made], [2, 3])
        self.assertEqual([(each.stable, each.unstable) for each in found.boundaries()], [(1, 10)])
        self.assertLess(FakeCampaign.made[1][1], FakeCampaign.made[0][1])


    def test_what_fails_for_other_reasons_says_nothing_of_stability(self):
        def verdict(code, **more):
            return stability.verdict({"failure": "something", "stopped": False, "exit code": code, **more})

        self.assertEqual(verdict(3), "failed")
        self.assertEqual(verdict(2, reached=0.5), "failed")  # such as a body that comes to a wall
        for code in (2, 4, 6, -11):
            self.assertEqual(verdict(code), "")


class Accuracy(unittest.TestCase):
    knobs = (Knob("step", {"Time/Step": [0.01]}, 2.0, 1.0, False), Knob("cells", {"Domain/Cells": [4000, 2000]}, 2.0, 2.0, True))

    def search(self, pilot, wanted, of=knobs):
        with open(os.devnull, "w") as nowhere:
            before, sys.stderr = sys.stderr, nowhere
            try:
                search = Search(pilot, of, wanted)
                search.run()
                return search
            finally:
                sys.stderr = before

    @staticmethod
    def model(*waves, orders=(2, 2)):
        """Of two things at factor one, whose neighbours, twice as coarse, differ by waves times 2^p - 1."""
        return ErrorModel([Part((2 ** p - 1) * wave, 2, 1, p, p, growth, growth)
                           for wave, p, growth in zip(waves, orders, (1, 2))], (1, 1))

    def test_the_cheapest_factors_for_an_error(self):
        one, other = numpy.array([0.1, 0]), numpy.array([0, 0.2])
        choices = [numpy.geomspace(0.2, 20, 200)] * 2
        model = self.model(one, other, orders=(2, 1))
        found = model.cheapest(0.01, choices)
        self.assertLessEqual(model.error(found), 0.01)
        for factor in choices[0]:  # no other pair is cheaper
            needed = next((each for each in choices[1] if model.error((factor, each)) <= 0.01), math.inf)
            self.assertLessEqual(model.cost(found), model.cost((factor, needed)) * (1 + 1e-9))
        self.assertIsNone(model.cheapest(1e-9, choices))

    def test_parts_that_cancel_are_no_accuracy(self):
        wave = numpy.array([1.0, -2.0, 0.5])
        size = convergence.norm(wave)
        self.assertAlmostEqual(self.model(0.1 * wave, -0.08 * wave).error((1, 1)), 0.1 * size)
        self.assertAlmostEqual(self.model(0.1 * wave, 0.08 * wave).error((1, 1)), 0.18 * size)
        self.assertAlmostEqual(self.model(0.1 * wave, -0.08 * wave).error((2, 1)), 0.08 * size)

    def test_errors_that_are_powers_are_found(self):
        for orders in ((2, 2), (1, 2), (2, 1.2)):
            for wanted in (0.05, 0.01, 0.002):
                pilot = FakePilot((0.02, 0.03), orders)
                found = self.search(pilot, wanted)
                self.assertLessEqual(pilot.true_error(found.setting), 1.1 * wanted)
                self.assertLess(abs(math.log(found.error / pilot.true_error(found.setting))), math.log(2))

    def test_orders_are_told_in_one_unit_although_the_size_of_the_quantity_changes(self):
        for orders in ((1, 1), (2, 1)):
            for wanted in (0.05, 0.01):
                pilot = FakePilot((0.2, 0.3), orders)
                found = self.search(pilot, wanted)  # is not refused
                self.assertLessEqual(pilot.true_error(found.setting), 1.1 * wanted)
                for level in found.levels[1:]:
                    for part, order in zip(level.model.parts, orders):
                        if part.seen is not None:
                            self.assertAlmostEqual(part.seen, order, 2)

    def test_what_half_of_the_error_would_take(self):
        for steep in (0.8, 1.0, 1.4):
            pilot = FakePilot((0.02, 0.03), (2, 2), steep=steep)
            found = self.search(pilot, 0.01)
            found.error *= 1.3  # more than the model has foretold was seen
            cost, is_enough = found.cost_of_half()
            self.assertTrue(is_enough)
            factors = cheapest(found.levels[-1], found.levels[-1].model,
                               found.levels[-1].model.error(found.setting.factors) / 2)
            setting = dataclasses.replace(found.setting, factors=factors)
            pilot.run(setting)
            self.assertGreater(cost, pilot.costs[found.setting])
            self.assertLess(abs(math.log(cost / pilot.costs[setting])), math.log(1.5))

    def test_runs_are_not_much_dearer_than_needed(self):
        for orders in ((2, 2), (1, 2), (2, 1.2)):
            for wanted in (0.01, 0.002):
                pilot = FakePilot((0.01, 0.015), orders)
                found = self.search(pilot, wanted)
                cost = pilot.costs[found.setting]
                grid = numpy.geomspace(0.5, 2, 12)
                settings = [dataclasses.replace(found.setting, factors=(found.setting.factors[0] * a, found.setting.factors[1] * b))
                            for a in grid for b in grid]
                accurate = [a for a in settings if pilot.run(a) is not None and pilot.true_error(a) <= wanted]
                self.assertLess(cost, 2 * min(pilot.costs[each] for each in accurate), f"orders {orders}, {wanted}")

    def test_what_does_not_grow_of_the_cost_is_told_from_what_does(self):
        for overhead in (0, 0.01, 0.05, 100):
            pilot = FakePilot((0.2, 0.3), (2, 2), overhead=overhead)
            level = Level(pilot, self.first_setting(pilot))
            for factors in ((0.5, 0.5), (1, 0.25), (0.25, 0.5)):
                setting = Setting(self.knobs, factors)
                pilot.run(setting)
                foretold = pilot.costs[level.setting] * level.model.cost(numpy.array(factors))
                self.assertLess(abs(math.log(foretold / pilot.costs[setting])), math.log(1.5), f"overhead {overhead}, {factors}")
            for part, knob in zip(level.model.parts, self.knobs):
                self.assertLessEqual(abs(part.growth / knob.growth - 1), 0.5)

    def first_setting(self, pilot):
        setting = Setting(self.knobs, (0.25, 0.25))
        pilot.run(setting)
        return setting

    def test_runs_before_the_last_one_are_cheap(self):
        for wanted in (0.01, 0.002, 0.0005):
            pilot = FakePilot((0.2, 0.3), (2, 2))
            found = self.search(pilot, wanted)
            cost = pilot.costs[found.setting]
            self.assertLess(sum(pilot.costs.values()) - cost, cost)

    def test_a_run_that_is_not_as_foretold_is_not_trusted(self):
        class Worse(FakePilot):
            """Whose error grows suddenly with fine steps."""

            def error(self, setting):
                step, cells = setting.factors
                found = FakePilot.error(self, setting)
                return found + 0.1 * numpy.sin(5 * self.times_of_rows) * (step > self.edge) * step ** -1.0

        for edge in (1, 2, 3):
            Worse.edge = edge
            pilot = Worse((0.2, 0.3), (2, 2))
            try:
                found = self.search(pilot, 0.01)
            except Refused:
                continue
            self.assertLess(pilot.true_error(found.setting), 0.02)

    def test_steps_of_a_run_with_outputs_land_on_them(self):
        for wanted in (0.3, 0.1, 0.01):
            step, cells = self.knobs
            limited = (dataclasses.replace(step, longest=0.005), cells)
            found = self.search(FakePilot((1e-4, 0.03), (2, 2)), wanted, limited)
            self.assertGreaterEqual(found.setting.factors[0], 2 * (1 - 1e-9))

    def test_the_growth_of_the_cost_is_seen_of_runs_with_outputs_too(self):
        """By the way that users take: each run leaves files of numbers, costs what settings make expect but for first runs that
        are too short to tell, and spends as much again on outputs, if it has any."""
        fake = FakePilot((0.2, 0.3), (2, 2))

        def leave(folder, words, outputs):
            step, cells = (next(word for word in words if word.startswith(key)).split("=")[1] for key in ("Time/Step", "Domain/Cells"))
            setting = Setting(self.knobs, (0.01 / float(step), float(cells.split(",")[0]) / 4000))
            values = fake.run(setting).values[:, 0]
            seconds = max(fake.costs[setting], 1.0)
            os.makedirs(folder, exist_ok=True)
            with open(os.path.join(folder, "statistics"), "w") as file:
                file.write("# 1: Time [s]\n# 2: a [1]\n" + "".join(f"{t:.12g} {v:.12g}\n" for t, v in zip(fake.times_of_rows, values)))
            with open(os.path.join(folder, "timing"), "w") as file:
                file.write(f"fluid   1   {seconds:.4f}   50.0\noutput   1   {outputs:.4f}   50.0\n  vtu   1   {outputs:.4f}   50.0\n")
            cost = seconds + outputs
            return {"failure": "", "stopped": False, "exit code": 0, "core seconds": cost, "wall seconds": cost, "elapsed": cost}

        def once(_program, of_study, setting, folder, _limit):
            return leave(os.path.join(folder, "run"), [f"{key}={value}" for key, value in setting.settings(of_study).items()], 0.0)

        def execute(words, _limit, _printed):
            return leave(words[words.index("--output") + 1], words, 50.0)

        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()), \
                unittest.mock.patch.object(runs, "once", once), unittest.mock.patch.object(runs, "execute", execute):
            pilot = Pilot("program", study(), lambda _: quantity_of("a", "over time"), folder, None,
                          Destination(os.path.join(folder, "results"), {}, False))
            search = Search(pilot, self.knobs, 0.002)
            search.run()
        self.assertGreater(len(search.levels), 1)
        for part, knob in zip(search.levels[-1].model.parts, self.knobs):
            self.assertAlmostEqual(part.growth, knob.growth, delta=0.1)
        self.assertGreater(pilot.spent(search.setting)[0][0], pilot.costs[search.setting] + 40)

    def test_where_coarser_runs_fail_finer_ones_are_used(self):
        """Also on the way, where the last level shows smaller errors than there are, and the next setting is coarser."""
        for cross in (0, 0.05, 0.2, -0.3):
            for wanted in (0.2, 0.1, 0.02):
                pilot = PilotOfShortSteps((0.04, 0.1), (2, 2))
                pilot.cross = cross
                found = self.search(pilot, wanted)
                self.assertLess(pilot.true_error(found.setting), 1.3 * wanted)
                self.assertLess(found.setting.factors[0], 6)

    def test_few_cells_and_spacings_that_cannot_be_coarser_are_refined(self):
        few = Knob("elements", {"Bodies/a/Cells": [3, 1]}, 2.0, 2.0, True)
        spacing = Knob("spacing", {"Particles/Spacing": [0.2]}, 1.0, 3.0, False, 0.2)
        for knob in (few, spacing):
            pilot = FakePilot((0.1,), (knob.order,))
            found = self.search(pilot, 0.02, (knob,))
            self.assertLess(pilot.true_error(found.setting), 0.022)
            self.assertGreaterEqual(min(setting.factors[0] for setting in pilot.values), 1)
            least = Setting((knob,), (knob.nearest(with_room(pilot, 0, knob)),))
            self.assertIsNotNone(coarser_neighbour(pilot, least, 0, 2.0))

    def test_a_run_without_a_whole_period_has_failed_and_no_more(self):
        times = numpy.linspace(0, 1, 101)
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()):
            pilot = Pilot("", study(), lambda _: quantity_of("a", "frequency"), folder, None)
            for factor, frequency in ((1.0, 0.5), (2.0, 3.0)):
                with open(os.path.join(folder, "statistics"), "w") as file:
                    file.write("# 1: Time [s]\n# 2: a [1]\n" + "".join(
                        f"{t:.12g} {-math.cos(2 * math.pi * frequency * t):.12g}\n" for t in times))
                pilot.take(Setting(self.knobs, (factor, 1.0)), {"stopped": False, "failure": "", "core seconds": 1.0}, folder)
            one, other = (Setting(self.knobs, (factor, 1.0)) for factor in (1.0, 2.0))
            self.assertIn("whole periods", pilot.failures[one])
            self.assertIsNone(pilot.run(one))
            self.assertAlmostEqual(pilot.run(other).values[0, 0], 3.0, 2)
            pilot = Pilot("", study(), lambda _: quantity_of("b", "end"), folder, None)
            with self.assertRaisesRegex(Refused, "no column 'b'"):
                pilot.take(one, {"stopped": False, "failure": "", "core seconds": 1.0}, folder)

    def test_of_earlier_runs_those_are_used_that_are_near_to_what_is_asked_for(self):
        pilot = FakePilot((0.02, 0.03), (2, 2))
        for step in (0.25, 0.5, 1, 2, 4):
            for cells in (0.25, 0.5, 1, 2, 4):
                pilot.run(Setting(self.knobs, (step, cells)))
        for wanted in (0.1, 0.02, 0.005):
            known = known_level(pilot, wanted)
            self.assertLessEqual(known.error(), 3 * wanted)
            self.assertGreater(known.error(), 0.3 * wanted)
        self.assertEqual(known_level(pilot, 1e-6).setting.factors, (4, 4))
        self.assertIsNone(known_level(FakePilot((0.02, 0.03), (2, 2)), 0.1))

    def test_neighbours_run_at_the_same_time(self):
        together, most = [], []

        def once(_program, _study, setting, folder, _limit):
            together.append(setting)
            time.sleep(0.2)
            most.append(len(together))
            together.remove(setting)
            os.makedirs(os.path.join(folder, "run"))
            with open(os.path.join(folder, "run", "statistics"), "w") as file:
                file.write(f"# 1: Time [s]\n# 2: a [1]\n0 1\n1 {1 + 0.1 / sum(setting.factors)}\n")
            return {"failure": "", "stopped": False, "core seconds": 1.0, "elapsed": 1.0}

        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()), \
                unittest.mock.patch.object(runs, "once", once):
            pilot = Pilot("", study(), lambda _: quantity_of("a", "end"), folder, None, jobs=2)
            level = Level(pilot, self.first_setting(pilot))
            level.see_orders()
        self.assertEqual((max(most), len(pilot.made), len(pilot.values)), (2, 5, 5))

    def test_starts_count_for_the_time_allowed(self):
        pilot = Pilot("", study(), lambda _: quantity_of("a", "end"), "", None)
        one = Setting(self.knobs, (1.0, 1.0))
        with contextlib.redirect_stderr(io.StringIO()):
            pilot.take(one, {"stopped": False, "failure": "fails", "core seconds": 1.0, "wall seconds": 2.0, "elapsed": 2.5}, "")
        self.assertAlmostEqual(pilot.seconds(one, 1), 2.5)
        self.assertAlmostEqual(pilot.seconds(one, 10), 20.5)
        self.assertEqual([readable(seconds) for seconds in (0.04, 2.26, 9.96, 30, 600)], ["0.0 s", "2.3 s", "10 s", "30 s", "10 min"])
        for start, is_refused in ((0.0, False), (2000.0, True)):
            fake = FakePilot((0.02, 0.03), (2, 2), deadline=time.monotonic() + 1000)
            fake.start = start
            if is_refused:
                with self.assertRaisesRegex(Refused, "it would take about 33 min"):
                    self.search(fake, 0.01)
            else:
                self.search(fake, 0.01)

    def test_earlier_runs_that_are_nearly_neighbours_are_used_as_such(self):
        exact, near = FakePilot((0.2, 0.3), (2, 2)), FakePilot((0.2, 0.3), (2, 2))
        one = Setting(self.knobs, (1.0, 1.0))
        for pilot in (exact, near):
            pilot.run(one)
        for factors in ((0.55, 0.95), (1.05, 0.5)):  # that lie beside neighbours
            near.run(Setting(self.knobs, factors))
        levels = [Level(pilot, one) for pilot in (exact, near)]
        self.assertEqual([len(pilot.values) for pilot in (exact, near)], [3, 3])
        for part, other, orders_of in zip(*(level.model.parts for level in levels), (2, 2)):
            self.assertLess(convergence.norm(part.error() - other.error()), 0.12 * convergence.norm(part.error()))
        self.assertLess(abs(levels[0].error() - levels[1].error()), 0.1 * levels[0].error())

    def test_what_matters_little_is_measured_again_before_a_setting_is_accepted_only(self):
        for late in (0.0, 0.002):  # an error that only fine cells show
            class Late(FakePilot):
                def error(self, setting):
                    step, cells = setting.factors
                    return FakePilot.error(self, setting) + late * self.times_of_rows ** 2 * (cells > 1) * step ** -2.0

            pilot = Late((1e-5, 0.5), (2, 2))
            found = self.search(pilot, 0.005)
            self.assertLess(pilot.true_error(found.setting), 1.5 * 0.005)
            self.assertTrue(found.levels[-1].is_complete())
            self.assertTrue(late or not all(level.is_complete() for level in found.levels))

    def test_grids_that_agree_by_chance_are_not_trusted(self):
        class Agreeing(FakePilot):
            """Of which grids half as fine as the scene's give nearly the same as these, by chance."""

            def error(self, setting):
                step, cells = setting.factors
                return FakePilot.error(self, Setting(setting.knobs, (step, 0.85)) if abs(cells - 0.5) < 0.1 else setting)

        for late, caution in ((0.5, 1.0), (0.25, 1.0), (0.125, 2.0), (0.01, 3.0)):
            early = orders.Difference(1.0, 2.0, 1.0)
            self.assertAlmostEqual(orders.caution(orders.Difference(2.0, 2.0, late), [early], 2.0), caution)
        self.assertEqual(orders.caution(orders.Difference(1.1, 2.0, 0.1), [early], 2.0), 1.0)
        pilot = Agreeing((0.02, 0.3), (2, 2))
        coarse = Level(pilot, self.first_setting(pilot))
        setting = Setting(self.knobs, (0.25, 1.0))
        pilot.run(setting)
        fine = Level(pilot, setting, coarse)
        true = convergence.norm(0.3 * numpy.sin(2 * pilot.times_of_rows)) / fine.scale
        self.assertGreater(fine.model.parts[1].size, 0.35 * true)
        self.assertIn("by chance", fine.cautions[0])

    def test_a_run_that_changes_nothing_confirms_nothing(self):
        class Stuck(FakePilot):
            def error(self, setting):
                least = [min(factor, self.finest) for factor in setting.factors]
                return FakePilot.error(self, Setting(setting.knobs, tuple(least)))

        for finest, factor, is_confirmed in ((9, 2.0, True), (9, 1.02, True), (0.25, 1.02, True), (0.25, 1.2, False), (0.25, 2.0, False)):
            pilot = Stuck((0.02, 0.03), (2, 2))
            pilot.finest = finest
            level = Level(pilot, self.first_setting(pilot))
            setting = Setting(self.knobs, tuple(factor * each for each in level.setting.factors))
            pilot.run(setting)
            self.assertEqual(level.confirmed_error(setting) is not None, is_confirmed, (finest, factor))

    def test_the_cheapest_settings_of_the_benchmark_are_accurate_whatever_the_truth_is(self):
        pilot = FakePilot((0.02, 0.03), (2, 2))
        setting = Setting(self.knobs, (2.0, 2.0))
        pilot.run(setting)
        truth = quantities.Values(pilot.times_of_rows, pilot.exact()[:, None])
        surely, perhaps, never = (estimates.best_cost(pilot, setting, 0.02, truth, sure) for sure in (0.0, 0.006, 0.03))
        self.assertLess(surely, perhaps)
        self.assertTrue(math.isnan(never))

    def test_what_does_not_converge_is_refused(self):
        with self.assertRaisesRegex(Refused, "do not come closer"):
            self.search(FakePilot((0, 0), (2, 2), noise=0.3), 0.01)

    def test_cells_along_all_axes_grow_alike(self):
        knob = Knob("elements", {"Bodies/a/Cells": [24, 3]}, 2.0, 2.0, True)
        for factor in knob.choices(0.3, 4):
            long, short = (int(each) for each in knob.settings(factor)["Bodies/a/Cells"].split(","))
            self.assertLess(abs(math.log(long / short / 8)), 0.2)

    def test_grids_and_elements_that_cannot_be_refined_are_named(self):
        found = {"Dimension": "2", "Scheme": "simultaneous", "Time/Step": "0.1", "Domain/Cells": "8, 8",
                 "Bodies/a/Cells": "2, 2", "Bodies/b/Shape": "cylinder", "Bodies/b/Cells": "3"}
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            knobs = knobs_of(found)
        self.assertEqual(knobs[-1].values, {"Bodies/a/Cells": [2, 2]})
        self.assertIn("elements of b", said.getvalue())
        with self.assertRaises(SystemExit) as refused:
            knobs_of({**found, "Domain/Planes y": "planes.txt"})
        self.assertIn("Planes y", str(refused.exception))

    def test_a_number_of_steps_is_no_end(self):
        found = {"Dimension": "2", "Scheme": "simultaneous", "Time/Step": "0.1", "Time/Maximum steps": "4294967295"}
        self.assertEqual(len(knobs_of(found)), 1)
        with self.assertRaises(SystemExit) as refused:
            knobs_of({**found, "Time/Maximum steps": "5"})
        self.assertIn("'Time/End'", str(refused.exception))

    def test_orders_in_time_are_those_of_integrators(self):
        for changed, order in (({}, 2), ({"Time/Integrator": "theta", "Time/Theta": "0.6"}, 1),
                               ({"Time/Integrator": "theta", "Time/Theta": "0.5"}, 2), ({"Scheme": "time_splitting"}, 1),
                               ({"Time/Integrator": "newmark", "Time/Gamma": "0.5"}, 2),
                               ({"Time/Integrator": "newmark", "Time/Gamma": "0.7"}, 1), ({"Time/Integrator": "generalised_alpha"}, 2)):
            found = {"Dimension": "2", "Scheme": "simultaneous", "Time/Step": "0.1", "Time/Integrator": "trapezoid_bdf2", **changed}
            self.assertEqual(knobs_of(found)[0].order, order, changed)

    def test_orders_are_between_a_least_one_and_that_of_theory(self):
        for seen, used in ((1.0, 1.0), (1.6, 1.6), (3.0, 2.0), (0.2, orders.SMALLEST_ORDER), (None, orders.UNSEEN_ORDER),
                           (math.nan, orders.SMALLEST_ORDER)):
            self.assertEqual(orders.order_to_use(seen, [], 2.0), used)

    def test_orders_are_those_of_all_differences_and_not_far_from_theory(self):
        def seen(*noises, order=1.5):
            differences = [orders.Difference(2.0 ** k, 2.0, math.exp(noise) * 2.0 ** (-order * k)) for k, noise in enumerate(noises)]
            return orders.likely(differences, 2.0)

        self.assertLess(abs(seen(0, 0, 0, 0) - 1.5), 0.1)
        self.assertLess(abs(seen(0, 0, 0, 0, 0, 0, 0) - 1.5), 0.02)
        self.assertLess(abs(seen(0, 0.3, -0.3, 0, order=2.0) - 2.0), 0.25)  # where the last two alone show 1.6, those before 2.9
        self.assertGreater(seen(0, 0.2), 1.4)  # by these two alone, 1.2
        self.assertLess(seen(0, 0, order=1.0), 1.5)
        coarse = [orders.Difference(2.0 ** -k, 2.0, size) for k, size in enumerate((0.1, 0.4, 0.7, 0.3))]
        self.assertEqual(orders.joined(coarse[:1], coarse[1:]), coarse[:3])  # before these, differences do not fall

    def test_an_order_is_confirmed_by_differences_at_other_factors_only(self):
        before = Part(numpy.array([1e-2]), 2, 1.0, 1.0, 2.0, 1, 1, seen=1.0, differences=[orders.Difference(1.0, 2, 1e-2)])
        self.assertEqual(Level.order_seen(orders.Difference(1.1, 2, 0.9e-2), before), 1.0)
        self.assertIsNone(Level.order_seen(orders.Difference(1.1, 2, 1e-1), before))  # has grown
        self.assertAlmostEqual(Level.order_seen(orders.Difference(2.0, 2, 0.5e-2), before), 1.0)
        pilot = FakePilot((0.2, 0.3), (1.3, 1.3))
        levels = []
        for factors in ((0.25, 0.25), (0.27, 0.25), (0.6, 0.25)):
            setting = Setting(self.knobs, factors)
            pilot.run(setting)
            levels.append(Level(pilot, setting, *levels[-1:]))
            levels[-1].see_orders()
        self.assertEqual([[len(part.differences) for part in level.model.parts] for level in levels], [[2, 2], [2, 2], [3, 2]])
        for part in levels[-1].model.parts:
            self.assertAlmostEqual(part.seen, 1.3, 6)

    def test_spacings_of_particles_divide_the_domain(self):
        self.assertAlmostEqual(common_length([1, 0.8]), 0.2)
        self.assertAlmostEqual(common_length([0.584, 0.35, 0.15]), 0.002)
        (knob,) = knobs_of({"Dimension": "2", "Scheme": "particle", "Particles/Spacing": "0.02", "Domain/Lower corner": "0, 0",
                            "Domain/Upper corner": "1, 0.8"})
        for factor in (0.21, 0.5, 1, 1.3, 2.7):
            spacing = float(knob.settings(knob.nearest(factor))["Particles/Spacing"])
            self.assertAlmostEqual(0.2 / spacing, round(0.2 / spacing), 9)


if __name__ == "__main__":
    unittest.main()
