#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages about runs by laws that they must obey: numbers are those of the files, nothing comes from outside or gets out of its
place, what is missing is left out, and what is spoilt is named."""
import base64
import io
import json
import os
import re
import sys
import tempfile
import unittest
import unittest.mock

import numpy
from PIL import Image

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
import sample_run  # noqa: E402
from report import (comparison, facts, frames, page_file, parameters, phases, plots, results, run_page, shapes, thinning,  # noqa: E402
                    verdict, vtu)
from seen_page import Page  # noqa: E402

LIMIT = 3_000_000  # bytes of a page without frames


class Folder(unittest.TestCase):
    """Tests with a made-up folder of results."""

    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)

    def folder(self, name="run", **keys):
        return sample_run.write(os.path.join(self.place.name, name), **keys)

    def put(self, folder, name, text):
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)

    def text(self, folder):
        return run_page.write(results.Results(folder))

    def without_drawing(self):
        """Pages take a hundredth of the time: for tests of what stands beside plots and pictures."""
        nothing = {"curves": [], "kind": "none"}
        for name, result in (("report.figure.draw", ("<svg></svg>", nothing)), ("report.scene_picture.draw", b"")):
            patch = unittest.mock.patch(name, return_value=result)
            patch.start()
            self.addCleanup(patch.stop)


class Numbers(Folder):
    def test_all_that_is_plotted_is_in_the_file(self):
        page = Page(self.text(self.folder(n_rows=3000)))
        rows = sample_run.rows_of(3000)
        at = {time: row for time, row in zip(rows[:, 1], rows)}
        names = [name for name, _ in sample_run.COLUMNS]
        found = set()
        for plot in page.plots.values():
            for curve in plot["curves"] if plot["kind"] not in ("stack", "sums") else []:
                times = plot["times"][curve["times"]]
                column = next(k for k in range(len(names))
                              if all(at[time][k] == value for time, value in zip(times, curve["values"])))
                self.assertEqual(len(times), len(curve["values"]))
                whole = rows[times[0] > 0:, column]  # the initial state has no step
                self.assertEqual((min(curve["values"]), max(curve["values"])), (whole.min(), whole.max()))
                found.add(names[column])
        self.assertEqual(found, set(names) - {"Step", "Time", "Step length", "Cut cells", "energy gain", "energy by forces",
                                              "energy by friction", "energy by sides", "energy by gravity"})

    def test_the_ledger_adds_up(self):
        page, rows = Page(self.text(self.folder(n_rows=50))), sample_run.rows_of(50)
        (stack,) = [plot for plot in page.plots.values() if plot["kind"] == "stack"]
        by_name = {curve["name"]: curve["values"] for curve in stack["curves"]}
        self.assertEqual(set(by_name), {"gain", "forces", "friction"})  # what is always zero and parts of others are not in it
        (parts,) = [plot for plot in page.plots.values() if plot["kind"] == "sums"]
        self.assertEqual([curve["name"] for curve in parts["curves"]], ["gravity"])
        numpy.testing.assert_allclose(by_name["forces"], rows[:, 8].cumsum(), rtol=1e-8, atol=1e-8)
        numpy.testing.assert_allclose(numpy.add(by_name["forces"], by_name["friction"]), by_name["gain"], atol=1e-7)

    def test_marks_lie_on_their_curves(self):
        """hover.js computes places from the data; Matplotlib has drawn them."""
        text = self.text(self.folder(n_rows=30))
        plots_of_page, seen = Page(text).plots, 0
        for identifier, plot in plots_of_page.items():
            for number, curve in enumerate(plot["curves"] if plot["kind"] == "lines" else []):
                path = re.search(rf'<g id="{identifier}_curve{number}">\s*<path d="([^"]*)"', text)[1]
                first, last = (numpy.array(found, float) for found in
                               (re.findall(r"[ML] (\S+) (\S+)", path)[k] for k in (0, -1)))
                left, top, width, height = plot["box"]
                x0, x1, y0, y1 = plot["limits"]
                scale = numpy.log if plot["logarithmic"] else (lambda y: y)
                for drawn, row in ((first, 0), (last, -1)):
                    place = (left + width * (plot["times"][0][row] - x0) / (x1 - x0),
                             top + height * (1 - (scale(curve["values"][row]) - scale(y0)) / (scale(y1) - scale(y0))))
                    numpy.testing.assert_allclose(drawn, place, atol=0.01)
                    seen += 1
        self.assertGreater(seen, 10)

    def test_thinning_keeps_extremes_of_every_interval(self):
        values = numpy.random.default_rng(3).normal(size=(20011, 3))
        rows = thinning.rows_to_draw(values, 600)
        self.assertTrue(len(rows) <= 602 and rows[0] == 0 and rows[-1] == 20010 and (numpy.diff(rows) > 0).all())
        for begin in range(0, 20011 - 500, 173):  # any 500 rows hold two whole intervals of 201 rows
            inside = rows[(rows >= begin) & (rows < begin + 500)]
            middle = values[begin + 201:begin + 299]
            self.assertTrue((values[inside].max(axis=0) >= middle.max(axis=0)).all())
            self.assertTrue((values[inside].min(axis=0) <= middle.min(axis=0)).all())

    def test_a_large_table_makes_a_small_page(self):
        folder = self.folder()
        columns = sample_run.COLUMNS[:2] + [(f"quantity {k} of things", "m") for k in range(120)]
        rows = numpy.random.default_rng(5).normal(size=(4000, 122))
        rows[:, 1] = numpy.arange(4000)
        self.put(folder, "statistics", sample_run.statistics(rows, columns))
        text = self.text(folder)
        self.assertLess(len(text.encode()), LIMIT)
        print(f"a page of 122 columns and 4000 rows: {len(text.encode()) / 1e6:.2f} MB")
        self.assertIn("quantity 119 of things", Page(text).sections["other-columns"])  # not drawn, but named


class Sections(Folder):
    def setUp(self):
        super().setUp()
        self.without_drawing()

    NEEDS = {"statistics": {"probes", "energies-and-steps", "ledger", "other-columns", "columns-that-never-change"},
             "summary.json": {"stability"}, "effects.json": {"effects"}, "timing": {"seconds"}, "parameters.prm": {"parameters"}}
    ANCHORS = {"columns-that-never-change": "constant"}

    def anchors(self, folder):
        return set(Page(self.text(folder)).sections) - {"", "first"}

    def test_there_is_a_section_for_each_file(self):
        expected = {self.ANCHORS.get(each, each) for each in set().union(*self.NEEDS.values())} | {"cite"}
        self.assertEqual(self.anchors(self.folder()), expected)

    def test_what_is_missing_is_left_out(self):
        everything = self.anchors(self.folder("all"))
        for name, sections in self.NEEDS.items():
            folder = self.folder(name)
            os.remove(os.path.join(folder, name))
            lost = everything - self.anchors(folder)
            self.assertEqual(lost, {self.ANCHORS.get(each, each) for each in sections}, name)
            self.assertEqual(results.Results(folder).problems, [])

    def test_what_is_spoilt_is_named(self):
        for name in ("statistics", "summary.json", "effects.json", "parameters.json", "solution.pvd", "solution/fluid_000007.vtu"):
            for spoil in (lambda text: text[:len(text) // 2], lambda text: "\x00nonsense\n" * 3, lambda text: "[1, 2]"):
                folder = self.folder()
                self.put(folder, name, spoil(sample_run.files()[name]))
                first = Page(self.text(folder)).sections["first"]
                self.assertTrue(name.split("/")[0].split(".")[0] in first, f"{name}: {first}")

    def test_every_prefix_of_every_file_makes_a_page(self):
        for name, whole in sample_run.files().items():
            folder = self.folder()
            for length in numpy.linspace(0, len(whole), 6).astype(int):
                self.put(folder, name, whole[:length])
                found = results.Results(folder)
                self.assertIn("first", Page(run_page.write(found)).sections, f"{name} cut at {length}")

    def test_contents_of_any_kind_make_a_page(self):
        for name in ("summary.json", "effects.json", "parameters.json"):
            whole = json.loads(sample_run.files()[name])
            folder = self.folder()
            for key in whole:
                for other in (3, "x", None, [], {}, [3], {"x": 3}):
                    self.put(folder, name, json.dumps({**whole, key: other}))
                    self.assertIn("first", Page(self.text(folder)).sections, f"{name}: {key} = {other}")

    def test_rows_that_are_torn_are_left_out(self):
        folder = self.folder()
        text = sample_run.files()["statistics"]
        self.put(folder, "statistics", text + "  3.0 nan\n" + text.splitlines()[-1].replace("e", "x") + "\n")
        found = results.Results(folder)
        numpy.testing.assert_array_equal(found.statistics.values, sample_run.rows_of(8))
        self.assertIn("2 of 10 rows", found.problems[0])

    def test_effects_cost_what_the_file_says(self):
        page = Page(self.text(self.folder()))
        for each in ("gravity", "20.0 %", "viscosity is off and would matter", "Reynolds number = 120"):
            self.assertIn(each, page.sections["effects"])

    def test_frames_are_a_film(self):
        folder = self.folder()
        os.mkdir(os.path.join(folder, "frames"))
        for number in range(130):
            Image.new("RGB", (1280, 40), (number, 0, 0)).save(os.path.join(folder, "frames", f"frame_{number:04d}.png"))
        self.put(folder, "frames/frame_0003.png", "no picture")
        page = Page(self.text(folder))
        pictures = page.plots["frames"]
        self.assertIn("43 of 130 frames", page.sections["frames"])
        self.assertIn("frame_0003", page.sections["first"])
        reds = []
        for picture in pictures:
            with Image.open(io.BytesIO(base64.b64decode(picture.partition(",")[2]))) as found:
                self.assertEqual(found.size[0], 720)
                reds.append(found.getpixel((5, 5))[0])
        numpy.testing.assert_allclose(reds, [number for number in range(0, 130, 3) if number != 3], atol=3)

    def test_a_film_is_shown_instead_of_frames(self):
        folder = self.folder()
        os.mkdir(os.path.join(folder, "frames"))
        Image.new("RGB", (40, 40)).save(os.path.join(folder, "frames", "frame_0000.png"))
        self.put(folder, "film.mp4", "moving pictures")
        page = Page(self.text(folder))
        self.assertIn("film", page.sections)
        self.assertIn("data:video/mp4;base64," + base64.b64encode(b"moving pictures").decode(), page.links)
        self.assertNotIn("frames", page.sections)
        with open(os.path.join(folder, "film.mp4"), "r+b") as file:
            file.truncate(frames.MOST_BYTES + 1)
        large = self.text(folder)
        self.assertLess(len(large), LIMIT)
        self.assertIn("film.mp4", Page(large).links)

    def test_frames_and_film_of_an_earlier_run_are_not_shown(self):
        folder = self.folder()
        os.mkdir(os.path.join(folder, "frames"))
        frame = os.path.join(folder, "frames", "frame_0000.png")
        Image.new("RGB", (40, 40)).save(frame)
        self.put(folder, "film.mp4", "moving pictures")
        self.put(folder, "original.prm", "set Dimension = 2\n")
        self.assertIn("film", Page(self.text(folder)).sections)
        begin = os.path.getmtime(os.path.join(folder, "original.prm"))
        for file in (frame, os.path.join(folder, "film.mp4")):
            os.utime(file, (begin - 3600, begin - 3600))
        page = Page(self.text(folder))
        self.assertNotIn("film", page.sections)
        self.assertNotIn("frames", page.sections)
        self.assertIn("of an earlier run", page.sections["first"])

    def test_phases_are_a_tree(self):
        top = phases.tree(os.path.join(self.folder(), "timing"))
        self.assertEqual([(phase.name, phase.seconds) for phase in top], [("initialise", 0.5), ("step", 1.0)])
        self.assertAlmostEqual(sum(phase.share for phase in top), 1)
        self.assertAlmostEqual(top[1].inner[0].share, 0.5)
        self.assertAlmostEqual(top[1].rest(), 0.25)

    def test_parameters_are_those_that_the_scene_sets(self):
        self.assertEqual(parameters.given(sample_run.PARAMETERS), [
            ("", "Title", "A sample", ""), ("Time", "Step", "0.01", "s"), ("Probes / tip", "Kind", "point", "")])


class Verdicts(Folder):
    def setUp(self):
        super().setUp()
        self.without_drawing()

    def kind(self, folder):
        found = verdict.of(results.Results(folder))
        return found.kind, found.word

    def test_colours_of_what_has_ended(self):
        self.assertEqual(self.kind(self.folder()), ("good", "stable"))
        self.assertEqual(self.kind(self.folder(verdict="growing")), ("bad", "growing"))
        self.assertEqual(self.kind(self.folder(verdict="undecided")), ("warning", "undecided"))
        self.assertEqual(self.kind(self.folder(verdict="failed", failure=sample_run.FAILURE)), ("bad", "failed"))
        self.assertEqual(self.kind(self.folder(failure="stopped by the signal 15")), ("neutral", "stopped, stable"))

    def test_a_law_that_is_broken_is_no_green(self):
        folder, text = self.folder(), sample_run.summary()
        text["certificate"]["margins"][0]["margin"] = -0.5
        self.put(folder, "summary.json", json.dumps(text))
        self.assertEqual(self.kind(folder)[0], "warning")

    def test_a_killed_run_is_not_called_ended(self):
        folder = self.folder()
        os.remove(os.path.join(folder, "summary.json"))
        self.put(folder, "record.txt", "# Files\nrun has begun\n")
        self.assertEqual(self.kind(folder), ("warning", "not ended"))

    def test_a_run_goes_on_as_long_as_its_process(self):
        folder, host = self.folder(), os.uname().nodename
        self.put(folder, "record.txt", "# Files\nrun has begun\n")
        self.put(folder, "lock", f"# A run of Undine is in this folder.\nhost {host}\nprocess {os.getpid()}\n")
        self.assertEqual(self.kind(folder)[0], "neutral")
        self.assertIn('http-equiv="refresh"', self.text(folder))
        self.put(folder, "lock", f"# A run of Undine is in this folder.\nhost {host}\nprocess 99999999\n")
        self.assertNotIn('http-equiv="refresh"', self.text(folder))

    def test_a_run_that_has_just_failed_does_not_go_on(self):
        """Its process writes the page. One that continues it has another verdict before its end."""
        folder = self.folder(verdict="failed", failure=sample_run.FAILURE)
        self.put(folder, "record.txt", "# Files\nrun has begun\n")
        self.put(folder, "lock", f"# A run of Undine is in this folder.\nhost {os.uname().nodename}\nprocess {os.getpid()}\n")
        for age, expected in ((-10, ("bad", "failed")), (10, ("neutral", "running"))):
            now = os.path.getmtime(os.path.join(folder, "summary.json"))
            os.utime(os.path.join(folder, "lock"), (now + age, now + age))
            self.assertEqual(self.kind(folder), expected)

    def test_a_failure_is_told_first_with_what_to_try(self):
        page = Page(self.text(self.folder(verdict="failed", failure=sample_run.FAILURE)))
        for words in ("failed", "the volume ratio is -0.1 <b>", "a shorter 'Time / Step'"):
            self.assertIn(words, page.sections["first"])
        self.assertIn("resume", page.sections["cite"])

    def test_advice_is_what_follows_the_word_try(self):
        self.assertEqual(verdict.advice_of("It broke. Try: a, or\n b. The state before it is kept."), ["a, or b"])
        self.assertEqual(verdict.advice_of("no number. Try a shorter Time/Step; 'statistics' ends."),
                         ["a shorter Time/Step; 'statistics' ends"])
        self.assertEqual(verdict.advice_of("Trying hard did not help"), [])

    def test_a_long_failure_begins_with_whole_sentences(self):
        text = "It broke at 0.5 s. " + "Because of this and that. " * 30
        found = verdict.Verdict("bad", "failed", "", text.strip())
        self.assertTrue(found.brief().endswith(".") and len(found.brief()) <= verdict.BRIEF)
        self.assertEqual(f"{found.brief()} {found.rest()}", text.strip())


class Safety(Folder):
    EVIL = "</script><script>alert(1)</script><img src=x onerror=alert(2)> \" ' & $x$ {{ 7 * 7 }}"

    def test_texts_stay_texts(self):
        folder, counted = self.folder(), Page(self.text(self.folder("plain"))).tags
        text = sample_run.summary("failed", self.EVIL)
        text.update(title=self.EVIL, scene=self.EVIL)
        self.put(folder, "summary.json", json.dumps(text))
        self.put(folder, "statistics", sample_run.files()["statistics"].replace("tip displacement", f"tip {self.EVIL}")
                 .replace("[m]", f"[{self.EVIL}]"))
        self.put(folder, "parameters.prm", f"set Title = {self.EVIL}\n")
        page = Page(self.text(folder))
        self.assertEqual(page.tags.count("script"), counted.count("script"))
        self.assertEqual(page.tags.count("img"), counted.count("img"))
        self.assertIn(self.EVIL, page.sections[""])
        self.assertIn(self.EVIL, page.sections["parameters"])

    def test_nothing_comes_from_outside(self):
        one, two = self.folder("one"), self.folder("two", n_rows=20)
        for text in (self.text(one), comparison.write([results.Results(one), results.Results(two)])):
            page = Page(text)
            for link in page.links:
                self.assertRegex(link, r"^(data:|#)")
            self.assertNotRegex(page.styles, r"@import|url\((?!#)")
            self.assertNotRegex(page.scripts[1], r"\bfetch\(|XMLHttpRequest|import\(|https?://(?!www\.w3\.org/2000/svg)")

    def test_files_of_others_stay(self):
        folder = self.folder()
        path = os.path.join(folder, page_file.NAME)
        self.put(folder, page_file.NAME, "mine")
        self.assertRaises(FileExistsError, page_file.write, path, self.text(folder))
        with open(path) as file:
            self.assertEqual(file.read(), "mine")
        os.remove(path)
        for _ in range(2):
            page_file.write(path, self.text(folder))
        with open(os.path.join(folder, "record.txt")) as file:
            self.assertEqual(file.read().count(f"file {page_file.NAME}\n"), 1)
        self.assertTrue(results.Results(folder).has_ended)


class Comparison(Folder):
    page = None  # is the same for all tests, and drawn once

    def setUp(self):
        super().setUp()
        if self.page:
            return
        self.folders = [self.folder(name, **keys) for name, keys in (
            ("one", {}), ("two", {"n_rows": 20, "verdict": "failed", "failure": sample_run.FAILURE}))]
        self.put(self.folders[1], "parameters.json", json.dumps({"Title": "A sample", "Time": {"Step": "0.02", "End": "1"},
                                                                 "Probes": {"tip": {"Kind": "point"}}}))
        Comparison.page = Page(comparison.write([results.Results(folder) for folder in self.folders]))

    def test_each_run_has_its_curve(self):
        for name, n_rows in (("one", 8), ("two", 20)):
            rows = sample_run.rows_of(n_rows)
            shown = [(plot["times"][curve["times"]], curve["values"]) for plot in self.page.plots.values()
                     for curve in plot["curves"] if curve["name"] == f"{name}, y"]
            self.assertEqual(shown, [(rows[:, 1].tolist(), rows[:, column].tolist()) for column in (15, 13)])

    def test_only_parameters_that_differ(self):
        table = " ".join(self.page.sections["parameters"].split())
        for words in ("Time/Step 0.01 0.02", "Time/End 1"):
            self.assertIn(words, table)
        self.assertNotIn("Title", table)

    def test_verdicts_side_by_side(self):
        for words in ("stable", "failed", "a shorter 'Time / Step'"):
            self.assertIn(words, self.page.sections["verdicts"])

    def test_names_tell_runs_apart(self):
        self.assertEqual(comparison.names_of(["a/x", "b/x"]), ["a/x", "b/x"])
        self.assertEqual(comparison.names_of(["a/x", "a/y"]), ["x", "y"])
        self.assertEqual(comparison.names_of(["a/x", "a/x"]), ["x (1)", "x (2)"])


class Geometry(Folder):
    def mesh(self, dimension, n):
        path = os.path.join(self.place.name, "mesh.vtu")
        points, cells = sample_run.box(n, dimension, 2.0)
        with open(path, "w") as file:
            file.write(sample_run.vtu(points, cells, {2: 9, 3: 12}[dimension], {"velocity": points, "pressure": points[:, :1]}))
        mesh = vtu.read(path)
        numpy.testing.assert_array_equal(mesh.points, points)
        numpy.testing.assert_array_equal(mesh.fields["velocity"], points)
        self.assertEqual(mesh.fields["pressure"].shape, (len(points), 1))
        return mesh

    def test_only_faces_without_a_neighbour_are_seen(self):
        for n in (1, 2, 5):
            (faces,) = shapes.surface(self.mesh(3, n), 3)
            self.assertEqual(len(faces), 6 * n * n)
            (cells,) = shapes.surface(self.mesh(2, n), 2)
            self.assertEqual(len(cells), n * n)
            self.assertEqual(len(shapes.outline(self.mesh(2, n))), 4 * n)

    def test_a_slice_has_the_area_of_the_section(self):
        for n in (1, 2, 3, 8):
            mesh = self.mesh(3, n)
            (cells,) = shapes.cells_of(mesh)
            which, quads = shapes.slice_through_middle(mesh, cells)
            self.assertEqual(len(which), n * n)
            sides = numpy.linalg.norm(numpy.cross(quads[:, 1] - quads[:, 0], quads[:, 3] - quads[:, 0]), axis=1)
            self.assertAlmostEqual(sides.sum(), 4.0)

    def test_a_view_keeps_lengths_across_it(self):
        for dimension in (2, 3):
            view = shapes.View(dimension)
            numpy.testing.assert_allclose(view.axes @ view.axes.T, numpy.eye(2), atol=1e-14)
            numpy.testing.assert_allclose(view.axes @ view.towards, 0, atol=1e-14)
        numpy.testing.assert_array_equal(shapes.View(2).flat(numpy.array([[3.0, 4.0, 0.0]])), [[3, 4]])


class Plots(unittest.TestCase):
    def test_components_share_a_plot_and_constants_have_none(self):
        table = results.Table(["Step", "Time", "tip x", "tip y", "tip z", "Cut cells"], ["1", "s", "m", "m", "m", "1"],
                              [[0, 0, 0, 0, 1, 5], [1, 1, 1, 2, 1, 5]])
        (plot,), constant, left_out = plots.of_table(table, ["tip"])
        self.assertEqual((plot.section, plot.names, plot.labels), ("Probes", ["tip x", "tip y"], ["x", "y"]))
        self.assertEqual((constant, left_out), ({"tip z": 1, "Cut cells": 5}, []))

    def test_the_longest_name_of_a_probe_counts(self):
        self.assertEqual(plots.probe_of("tip two pressure", ["tip", "tip two"]), "tip two")
        self.assertEqual(plots.probe_of("tipper", ["tip"]), "")

    def test_units_of_facts(self):
        self.assertEqual([facts.seconds(value) for value in (0.5, 90, 120, 7200)], ["0.5 s", "90 s", "2 min", "2 h"])
        self.assertEqual(facts.memory(1.5e8), "150 MB")


if __name__ == "__main__":
    unittest.main()
