#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""benchmarks/scaling.py and benchmarks/coupled_solver.py in a tiny form: what they measure, the model of scaling, and that
tables and plots can be made again from their numbers alone.

usage: check_cost_benchmarks.py PROGRAM
"""
import os
import subprocess
import sys
import tempfile
import unittest

import scene_tools

BENCHMARKS = os.path.join(scene_tools.ROOT, "benchmarks")
sys.path.insert(0, BENCHMARKS)
import scaling  # noqa: E402
import scaling_model  # noqa: E402
import step_costs  # noqa: E402

PROGRAM = os.path.abspath(sys.argv.pop(1))


def benchmark(name, *words, path=""):
    """What one of them prints, and what it says besides."""
    done = subprocess.run([sys.executable, "-B", os.path.join(BENCHMARKS, name), *words], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": path})
    if done.returncode:
        raise RuntimeError(done.stdout + done.stderr)
    return done.stdout, done.stderr


def without_matplotlib(folder):
    """A folder of modules in which there is no such one."""
    with open(os.path.join(folder, "matplotlib.py"), "w") as file:
        file.write("raise ImportError('no matplotlib')\n")
    return folder


class Scaling(unittest.TestCase):
    def test_model_finds_its_terms(self):
        for terms in ((1, 2, 3), (0, 5, 0), (0.5, 0, 0), (0, 8, 0.01)):
            points = [(ranks, scaling_model.seconds(terms, ranks)) for ranks in (1, 2, 4, 8, 16)]
            for found, wanted in zip(scaling_model.fit(points, 1e-3), terms):
                self.assertAlmostEqual(found, wanted, 6)

    def test_model_has_no_negative_terms(self):
        falling = [(ranks, 5 / ranks - 0.1) for ranks in (1, 2, 4, 8)]
        self.assertTrue(all(term >= 0 for term in scaling_model.fit(falling, 1e-3)))

    def test_parts_add_up_to_a_step(self):
        phases = {"transport": 1.0, "transport / convection": 0.5, "couple": 2.0, "couple / solve": 1.5, "couple / solve / inner": 1.0, "a step": 3.0}
        self.assertEqual(step_costs.parts(phases), {"transport": 1.0, "couple / solve": 1.5, "couple: the rest": 0.5})

    def test_weak_runs_grow_with_ranks(self):
        grid, elements, step = scaling.sizes(scaling.SCENES["jet_28k"], "weak", 8, None)
        self.assertEqual((grid, elements), ((96, 48, 48), (28, 17)))
        self.assertAlmostEqual(step, 1 / 60)

    def test_first_bottleneck(self):
        found = {("strong", "jet_28k", str(ranks), "1000", "0", "1"): {
            ("a step", "s a step"): 4 / ranks + 0.1 * k, ("transport", "s a step"): 4 / ranks, ("couple", "s a step"): 0.1 * k,
            ("unknowns", "1"): 1000, ("peak memory", "bytes"): 1e8, ("peak memory of an unknown", "bytes"): 1e5}
            for k, ranks in enumerate((1, 2, 4, 8))}
        self.assertRegex(scaling.report(found), r"First bottleneck of an extrapolation to 10000 .*\*\*couple\*\*")

    def test_runs_of_one_and_two_ranks(self):
        with tempfile.TemporaryDirectory() as folder:
            text, said = benchmark("scaling.py", PROGRAM, "--ranks", "1,2", "--scenes", "jet", "--weak", "only", "--cells", "600",
                                   "--steps", "1", "--output", folder, path=without_matplotlib(folder))
            self.assertIn("no plot", said)
            found = step_costs.read_listing([os.path.join(folder, "scaling.csv")])
            self.assertEqual([run[2] for run in found], ["1", "2"])
            two = found[list(found)[1]]
            if "Messages were not counted" not in text:
                self.assertGreater(two["messages of pairs", "a step"], 10)
                self.assertGreater(two["bytes of collectives", "a step"], 10)
            self.assertIn(("couple / solve linear system", "s a step"), two)
            self.assertGreater(two["peak memory of an unknown", "bytes"], 1000)
            again, _ = benchmark("scaling.py", "--plot", os.path.join(folder, "scaling.csv"), "--output",
                                 os.path.join(folder, "again"))
            self.assertEqual(text, again)
            for suffix in ("svg", "png"):
                self.assertGreater(os.path.getsize(os.path.join(folder, "again", f"scaling_weak.{suffix}")), 1000)


class CoupledSolver(unittest.TestCase):
    def test_programs_and_settings_are_compared(self):
        with tempfile.TemporaryDirectory() as folder:
            text, _ = benchmark("coupled_solver.py", PROGRAM, "--against", PROGRAM, "--quick", "--steps", "1", "--scenes",
                                "closed_chamber", "--settings", "Coupling/Nonsense=1", "--settings", "Coupling/Multigrid=geometric",
                                "--output", folder)
            self.assertEqual(text.count("| does not know this key |"), 2)
            self.assertRegex(text, r"\n\| closed_chamber \| \S+ \| Coupling/Multigrid=geometric \| [\d.e-]+ \|")
            self.assertRegex(text, r"Without a result by one of them: closed_chamber")
            for suffix in ("svg", "png", "csv", "md"):
                self.assertGreater(os.path.getsize(os.path.join(folder, f"coupled_solver.{suffix}")), 1000)


unittest.main()
