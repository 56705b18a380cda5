#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The mutating tester finds each fault that a fake program commits, and none that it does not.

usage: test_fuzz.py
"""
import sys

sys.dont_write_bytecode = True

import pathlib  # noqa: E402
import random  # noqa: E402
import subprocess  # noqa: E402
import tempfile  # noqa: E402
import unittest  # noqa: E402

import cases  # noqa: E402
import equivalents  # noqa: E402
import expressions  # noqa: E402
import fuzz  # noqa: E402
import judge  # noqa: E402
import key_types  # noqa: E402
import mild_mutations  # noqa: E402
import minimise  # noqa: E402
import process  # noqa: E402
import scene_reader  # noqa: E402
import seeds  # noqa: E402
import verdicts  # noqa: E402

FOLDER = pathlib.Path(__file__).resolve().parent
PYTHON = f"{sys.executable} -B -S"  # starts fast: no packages are needed
FAKE = str(FOLDER / "fake_program.py")
SCENE = "# {title}\nset Title = {title}\nset Dimension = 2\nsubsection Time\n  set End = {end}\nend\n"
VERDICTS = {
    "crash": "crash", "unexpected condition": "unexpected condition", "exit code": "exit code",
    "exit code of a signal": "exit code", "timeout": "timeout", "memory": "memory", "no message": "unclear message",
    "message without place": "unclear message", "message with control characters": "unclear message",
    "wrong place": "wrong place", "false mistake": "false mistake", "foreign file": "quotes a foreign file", "validate writes": "wrote elsewhere",
    "run crashes": "crash", "run goes on": "timeout", "run refuses": "validate and run differ",
    "run writes elsewhere": "wrote elsewhere", "misread value": "misread", "broken JSON": "broken file",
    "broken XML": "broken file", "not finite": "not finite", "not repeatable": "not repeatable",
    "resume differs": "resume differs", "ranks differ 2": "ranks differ"}


def case(title, end="1.5"):
    return seeds.Case({"scene.prm": SCENE.format(title=title, end=end).encode()}, "scene.prm", [], [], seed="a")


class Verdicts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)
        process.GRACE = 0.5
        self.program = process.Program(FAKE, f"env FAKE_RANKS={{ranks}} {PYTHON}", process.Limits(5., 0.2))
        self.judge = judge.Judge(self.program, key_types.KeyTypes(fuzz.reference(self.program, self.work)), self.work,
                                 steps=3)

    def of(self, one, seeds_by_name=None):
        outcome = self.judge.judge(one, "case", seeds_by_name)
        self.assertFalse((self.work / "case").exists())
        return outcome.answer, [verdict for verdict, _ in outcome.found]

    def test_each_fault(self):
        for title, verdict in VERDICTS.items():
            self.judge.ranks = (1, 2) if "ranks" in title else (1,)
            with self.subTest(title):
                self.assertIn(verdict, self.of(case(title))[1])

    def test_no_fault(self):
        for title, answer in (("good", "run"), ("refused", "refused"), ("run is stopped", "stopped")):
            with self.subTest(title):
                self.assertEqual(self.of(case(title)), (answer, []))

    def test_particles_on_several_ranks(self):
        self.judge.ranks = (1, 2)
        for title, wrong in (("particles", False), ("particles refused", True), ("good", True)):
            one = case(title)
            one.assignments = ["Scheme=particle"]
            with self.subTest(title):
                answer, found = self.of(one)
                self.assertEqual((answer, "ranks differ" in found, bool(found)), ("run", wrong, wrong))

    def test_odd_folders_of_results(self):
        self.judge.ranks = (1, 2)
        for output in ("a/../b", "a//b/", "./-a", "a\nb", "a" * 200):
            one = case("good")
            one.output = output
            with self.subTest(output):
                self.assertEqual(self.of(one), ("run", []))

    def test_too_long_name_of_results(self):
        one = case("good")
        one.output = "a" * 300
        self.assertEqual(self.of(one), ("failed", ["exit code"]))  # 1, of Python

    def test_keys_with_odd_bytes(self):
        one = case("good")
        one.files["scene.prm"] = b"set a\tb = 1\nset c\xff = 1\nset e\\\nf = 1\n"
        message = "scene.prm:{}: top level, key '{}': there is no such key"
        for line, key, wrong in ((1, "a?b", 0), (2, "c\\xff", 0), (1, "c\\xff", 1), (4, "e f", 0), (2, "a d", 1)):
            with self.subTest(key):
                self.assertEqual(len(verdicts.wrong_places(one, message.format(line, key))), wrong)

    def test_end_after_the_limit(self):
        for title, detail in (("timeout", "no end"), ("run goes on", "no end, neither by itself nor by a signal")):
            self.assertIn(("timeout", detail), self.judge.judge(case(title), "case").found)

    def test_what_must_not_be_accepted(self):
        self.judge.steps = 0
        for end in ("1,5", "t", "rand()", "1e", "", "inf", "1/(1-1)*x", "1;5", "sin(1"):
            with self.subTest(end):
                self.assertIn("misread", self.of(case("good", end))[1])
        self.judge.steps = 1
        for end in ("1.5", "3/2", "1e-310", "max(1,2)", "0x10"):
            with self.subTest(end):
                self.assertNotIn("misread", self.of(case("good", end))[1])

    def test_unknown_key(self):
        one = case("good")
        one.assignments = ["Time/Stepp=1"]
        self.assertIn("misread", self.of(one)[1])

    def test_equivalent(self):
        for title, expected in (("good", []), ("equivalent differs", ["equivalent differs"])):
            seed = case(title)
            seed.files["scene.prm"] = seed.files["scene.prm"].partition(b"\n")[2]
            other = case(title)
            other.equivalent = True
            self.judge.of_seeds.clear()
            self.assertEqual(self.of(other, {"a": seed})[1], expected)

    def test_minimised(self):
        self.judge.steps = 0
        one = case("crash")
        one.files["scene.prm"] += b"# a\n" * 50
        one.files["other.inc"] = b"# b\n"
        one.assignments = ["Time/End=2"]
        small = minimise.Minimiser(lambda other: "crash" in self.of(other)[1]).minimise(one)
        self.assertEqual((small.files, small.assignments), ({"scene.prm": b"set Title =crash"}, []))


class Oracles(unittest.TestCase):
    def test_reader(self):
        files = {"a.prm": b"\xef\xbb\xbfset A = 1 # b\r\nsubsection B\n set C = \\\n  x\\#y\n include b.inc\nend",
                 "b.inc": b"set D = 2"}
        scene = scene_reader.read_scene(files, "a.prm", ["B/C=3=4"])
        self.assertEqual((scene.values, scene.mistakes), ({"A": "1", "B/C": "3=4", "B/D": "2"}, []))

    def test_reader_finds_mistakes(self):
        for text in ("end", "subsection A", "set A", "a = 1", "set A = 1\nset A = 2", "include b.inc", "include a.prm"):
            with self.subTest(text):
                self.assertTrue(scene_reader.read_scene({"a.prm": text.encode()}, "a.prm").mistakes)

    def test_expressions(self):
        for text, value in (("1/3", 1 / 3), ("-2^2", -4), ("2^3^2", 512), ("2*(1+pi)", 2 * (1 + 3.141592653589793)),
                            ("1e-2", 0.01), ("8-2-1", 5), ("max(1, 2)", 2)):
            self.assertAlmostEqual(expressions.constant(text), value, delta=1e-15 * abs(value))
        for text in ("1,5", "x", "1 5", "(1", "rand()", "1e", "pi=3,1"):
            with self.subTest(text), self.assertRaises((expressions.NoExpression, expressions.Unknown)):
                expressions.constant(text)

    def test_functions(self):
        expressions.function_of("1, 2", "xyt", 2)
        expressions.function_of("if(x<1,y,t); 2", "xyt", 2)
        for text in ("1", "1,5; 2", "z; 0", "rand(); 0", "1; 2; 3"):
            with self.subTest(text), self.assertRaises(expressions.NoExpression):
                expressions.function_of(text, ("x", "y", "t"), 2)


class Making(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        reference = (FOLDER.parents[1] / "doc/parameters.md").read_text()
        cls.key_types = key_types.KeyTypes(reference)
        cls.seeds = seeds.read_seeds(FOLDER.parents[1])

    def test_same_case_again(self):
        one, other = (cases.Cases(self.seeds, self.key_types, "5") for _ in range(2))
        for number in range(150):
            other.make(number + 7)
            self.assertEqual(one.make(number), other.make(number))
        self.assertNotEqual(one.make(1), one.make(2))

    def test_every_mutation_occurs(self):
        maker = cases.Cases(self.seeds, self.key_types, "1")
        found = {name for number in range(600) for name in maker.make(number).mutations}
        self.assertEqual(found, {*maker.mutations, *mild_mutations.MUTATIONS, *equivalents.EDITS})

    def test_equivalents_change_no_value(self):
        rng = random.Random(1)
        for seed in self.seeds:
            if "/malformed/" in seed.seed:
                continue
            before = scene_reader.read_scene(seed.files, seed.scene)
            self.assertEqual(before.mistakes, [])
            for edit in equivalents.EDITS.values():
                one = seed.copy()
                edit(rng, one, self.key_types)
                after = scene_reader.read_scene(one.files, one.scene, one.assignments)
                self.assertEqual((after.mistakes, after.values.keys()), ([], before.values.keys()))
                if edit is not equivalents.numbers:
                    self.assertEqual(after.values, before.values, edit)
                equivalents.numbers(rng, one, self.key_types)  # of lines that are edited already
                after = scene_reader.read_scene(one.files, one.scene, one.assignments)
                self.assertEqual((after.mistakes, after.values.keys()), ([], before.values.keys()), edit)


class Whole(unittest.TestCase):
    def test_main_program(self):
        with tempfile.TemporaryDirectory() as folder:
            log, keep = pathlib.Path(folder, "log"), pathlib.Path(folder, "keep")
            result = subprocess.run([sys.executable, FOLDER / "fuzz.py", FAKE, "--launcher", PYTHON, "--cases", "8", "--log", log, "--keep", keep],
                                    capture_output=True, text=True)
            lines = log.read_text().splitlines()
            self.assertEqual(len(lines), 8, result.stderr)
            self.assertRegex(result.stdout, r"8 cases, [1-8] wrong\n\Z")  # the fake knows few keys
            self.assertEqual(result.returncode, 1)
            self.assertTrue(any(keep.iterdir()))


if __name__ == "__main__":
    unittest.main()
