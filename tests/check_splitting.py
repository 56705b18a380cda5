#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Light sheets: solved in turns with the fluid they shake, solved with it at the same steps they do not.
Heavy sheets: both ways agree, and twice as well with half the step.

usage: check_splitting.py PROGRAM SCENE.prm
"""
import os
import sys
import tempfile

import scene_tools

HEAVY = [f"Bodies/{sheet}/{assignment}" for sheet in ("first", "second")
         for assignment in ("Density=12000", "Young's modulus=5e5")] + [
             "Fluid/Boundaries/jet/Velocity=0.5; 0"]
SCHEMES = {"simultaneous": ["Scheme=simultaneous"],
           "velocity": ["Scheme=time_splitting", "Coupling/Fluid driven by=velocity"],
           "displacement": ["Scheme=time_splitting", "Coupling/Fluid driven by=displacement"]}


def run(arguments, end, scheme, assignments):
    """Columns by name; raises RuntimeError if a step fails."""
    with tempfile.TemporaryDirectory() as folder:
        settings = SCHEMES[scheme] + assignments + [
            f"Time/End={end}", "Output/Interval=0", "Output/Parts=statistics"]
        words = [word for setting in settings for word in ("--set", setting)]
        scene_tools.run(arguments[0], [arguments[1], "--output", os.path.join(folder, "run")] + words)
        names, _, rows = scene_tools.parse(scene_tools.statistics(os.path.join(folder, "run")))
        return dict(zip(names, zip(*rows)))


def light(arguments):
    largest = max(run(arguments, 1, "simultaneous", [])["solid kinetic energy"])
    print(f"light sheets: at most {largest:.3g} J of kinetic energy")
    for scheme in ("velocity", "displacement"):
        try:
            shaking = run(arguments, 1, scheme, [])["solid kinetic energy"][-1]
            print(f"  fluid driven by {scheme}: {shaking:.3g} J at the end")
            if shaking < 10 * largest:
                yield f"light sheets, fluid driven by {scheme}: only {shaking:.3g} J"
        except RuntimeError as error:
            if ", which begins at " not in str(error):
                yield f"light sheets, fluid driven by {scheme}: {error}"


def heavy(arguments):
    found = []
    for per_second in (30, 60):
        step = [f"Time/Step=1/{per_second}"]
        one, other = (run(arguments, 2, scheme, HEAVY + step)["first_tip displacement x"]
                      for scheme in ("simultaneous", "velocity"))
        found.append(max(abs(a - b) for a, b in zip(one, other)) / max(map(abs, one)))
    print("heavy sheets: the tips differ by " + ", ".join(f"{value:.3%}" for value in found))
    if found[0] > 0.05:
        yield f"heavy sheets differ by {found[0]:.3%}"
    if not 1.7 < found[0] / found[1] < 2.3:
        yield f"heavy sheets differ by {found[0]:.3%}, with half the step by {found[1]:.3%}"


def main():
    arguments = sys.argv[1:3]
    found = list(light(arguments)) + list(heavy(arguments))
    if found:
        sys.exit("\n".join(found))


main()
