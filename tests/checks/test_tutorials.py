#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The tests of tutorials and of what scenes say of their cost find what is wrong."""
import json
import pathlib
import tempfile
import unittest
from unittest import mock

import check_tutorials
import scene_costs


class Tutorials(unittest.TestCase):
    def test_commands_need_a_marker(self):
        with self.assertRaisesRegex(check_tutorials.Fault, "without a marker"):
            list(check_tutorials.blocks("```sh\nls\n```\n"))
        self.assertEqual(list(check_tutorials.blocks("<!-- run: A/B=1 | C=2, 3 -->\n```sh\nls\n```\n")),
                         [("run", "A/B=1 | C=2, 3", "ls\n")])
        self.assertEqual(list(check_tutorials.blocks("```\nshown\n```\n")), [])

    def test_commands(self):
        self.assertEqual(list(check_tutorials.commands("a b \\\n  c   # why\n\n# no\nd\n")), ["a b    c", "d"])

    def test_short_form(self):
        self.assertEqual(check_tutorials.short("./undine a.prm --set E=9", "Time/End=1 | C=2, 3"),
                         "./undine a.prm --set E=9 --set Time/End=1 --set 'C=2, 3'")
        self.assertEqual(check_tutorials.short("./undine study a.prm", "Time/End=1"), "./undine study a.prm")

    def test_what_is_printed(self):
        check_tutorials.assert_printed("one two\n...\nfour", "one  two\nthree\nfour five")
        for wanted in ("one three", "four\none", "six"):
            with self.assertRaisesRegex(check_tutorials.Fault, "not printed"):
                check_tutorials.assert_printed(wanted, "one two\nthree\nfour")

    def test_sources_stay_as_they_are(self):
        with tempfile.TemporaryDirectory() as name:
            sources, folder = pathlib.Path(name, "sources"), pathlib.Path(name, "mirror")
            (sources / "a" / "b").mkdir(parents=True)
            (sources / "a" / "b" / "old").write_text("old")
            folder.mkdir()
            (folder / "a").symlink_to(sources / "a")
            with check_tutorials.open_for_writing(folder, "a/b/new", "w") as file:
                file.write("new")
            self.assertEqual(sorted(path.name for path in (folder / "a" / "b").iterdir()), ["new", "old"])
            self.assertEqual([path.name for path in (sources / "a" / "b").iterdir()], ["old"])
            with self.assertRaises(check_tutorials.Fault):
                check_tutorials.open_for_writing(folder, "a/b/old", "w")


class SceneCosts(unittest.TestCase):
    ROW = {"core seconds": "200", "bytes": "3.2e7", "core seconds of two steps": "4",
           "seconds of the yardstick": "0.1"}

    def faults(self, head, seconds, size, yardstick=0.1):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "a.prm")
            scene.write_text(head)
            results = pathlib.Path(folder, "results")
            results.mkdir()
            (results / "summary.json").write_text(json.dumps({"cost": {"core seconds": seconds}, "steps": 2, "time [s]": 1}))
            (results / "parameters.json").write_text(json.dumps({"Time": {"End": "1", "Step": "0.1"}, "Output":
                                                                 {"Interval": "0.05"}}))
            (results / "statistics").write_text("# 1: Step [1]\n0\n1\n")
            (results / "solution").mkdir()
            (results / "solution" / "fluid_000000.vtu").write_text("at the start nothing")
            (results / "solution" / "fluid_000002.vtu").write_bytes(bytes(int(size / 21)))
            with mock.patch.object(scene_costs, "rows", lambda: {"a": self.ROW}), \
                    mock.patch.object(scene_costs, "yardstick", lambda: yardstick):
                return scene_costs.faults(scene, results)

    def test_words(self):
        self.assertEqual(scene_costs.in_words(0.2, 1e5), ("1 s", "1 MB"))
        self.assertEqual(scene_costs.in_words(43.4, 2.34e7), ("43 s", "23 MB"))
        self.assertEqual(scene_costs.in_words(431, 3.21e9), ("7 min", "3.2 GB"))
        self.assertEqual(scene_costs.in_words(40000, 1e6), ("11 h", "1 MB"))

    def test_faults(self):
        head = "# A.\n# Takes about 3 min on one core and writes about 32 MB.\nset Title = A\n"
        self.assertEqual(self.faults(head, 4, 3.2e7), [])
        self.assertEqual(self.faults(head, 11, 3.2e7), [])
        self.assertEqual(self.faults(head, 20, 3.2e7, yardstick=0.3), [], "a machine that is slower by 3")
        for wrong, word in (((head, 13, 3.2e7), "core seconds"), ((head, 0.7, 3.2e7), "core seconds"), ((head, 4, 1e8), "bytes"),
                            ((head.replace("3 min", "9 min"), 4, 3.2e7), "must say"), (("set Title = A\n", 4, 3.2e7), "must say")):
            found = self.faults(*wrong)
            self.assertEqual(len(found), 1, found)
            self.assertIn(word, found[0])


if __name__ == "__main__":
    unittest.main()
