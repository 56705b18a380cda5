#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What linear theory foretells of time splitting ('Output / Stability of splitting'), against how runs really grow: small
motions of a bar and of sheets in a fluid that is too heavy, with several integrators, with damping, in the plane and in space.

usage: check_linear_theory.py PROGRAM SCENES
"""
import json
import math
import os
import sys
import tempfile

import scene_tools

START, END = 1e-9, 1e-3  # of the motion [m], [m/s]: Newton's method cannot see much less, and more is not small
ALLOWED = 0.01  # of the growth in a step

COMMON = {"Scheme": "time_splitting", "Time/Maximum cuts": "0", "Time/Energy monitor": "off", "Output/Interval": "0",
          "Output/Parts": "statistics", "Output/Stability of splitting": "true"}
PISTON = {"Bodies/bar/Initial displacement": f"{START}*sin(40*x); 0", "Bodies/bar/Cells": "8, 1", "Domain/Cells": "8, 2",
          "Time/Integrator": "theta"}
SHEETS = {"Fluid/Boundaries/jet/Velocity": "0; 0", "Bodies/first/Initial velocity": f"{START}*sin(300*y); 0",
          "Bodies/second/Initial velocity": f"{START}*sin(300*y); 0"}
SPACE = {"Fluid/Boundaries/jet/Velocity": "0; 0; 0", "Bodies/first/Initial velocity": f"{START}*sin(40*y); 0; 0",
         "Domain/Cells": "16, 8, 8", "Bodies/first/Cells": "1, 5, 3", "Bodies/second/Cells": "1, 5, 3", "Time/Integrator": "theta", "Bodies/first/Density": "4", "Bodies/second/Density": "4"}
DAMPING = {"Effects/damping/Mass coefficient": "3", "Effects/damping/Stiffness coefficient": "1e-3"}

# Scene, how far a step is [s], density of the fluid (as it is without), settings.
CASES = {
    "theta, u": ("piston", "1/50", "10", PISTON),
    "theta, w": ("piston", "1/400", "12", {**PISTON, "Coupling/Fluid driven by": "displacement"}),
    "midpoint rule, u": ("piston", "1/200", "5", {**PISTON, "Time/Theta": "0.5"}),
    "Newmark, u": ("piston", "1/200", "5", {**PISTON, "Time/Integrator": "newmark"}),
    "Newmark, w": ("piston", "1/200", "12", {**PISTON, "Time/Integrator": "newmark", "Coupling/Fluid driven by": "displacement"}),
    "damping, u": ("piston", "1/100", "8", {**PISTON, **DAMPING}),
    "sheets, u": ("jet_two_sheets_split_2d", "1/60", "", {**SHEETS, "Bodies/first/Density": "55", "Bodies/second/Density": "55"}),
    "sheets, w": ("jet_two_sheets_split_2d", "1/60", "", {**SHEETS, "Bodies/first/Density": "24", "Bodies/second/Density": "24",
                                                          "Coupling/Fluid driven by": "displacement"}),
    "sheets in space, u": ("jet_two_sheets", "1/60", "", SPACE),
}


def arguments(scenes, scene, step, density, settings, folder, end):
    settings = {**COMMON, **settings, "Time/Step": step, "Time/End": end, **({"Fluid/Density": density} if density else {})}
    result = [os.path.join(scenes, scene + ".prm"), "--overwrite", "--output", folder]
    for key, value in settings.items():
        result += ["--set", f"{key}={value}"]
    return result


def foretold(folder):
    with open(os.path.join(folder, "summary.json")) as file:
        return json.load(file)["stability of splitting"]


def measured(folder):
    """The factor by which velocities of the bodies grow in a step, by a line through the logarithms of their energy in the
    second half of a run."""
    names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    logarithms = [math.log(row[names.index("solid kinetic energy")]) / 2 for row in rows[len(rows) // 2:]]
    middle = (len(logarithms) - 1) / 2
    slope = (sum((k - middle) * value for k, value in enumerate(logarithms))
             / sum((k - middle) ** 2 for k in range(len(logarithms))))
    return math.exp(slope)


def check(program, scenes, name, case):
    with tempfile.TemporaryDirectory() as folder:
        scene_tools.run(program, arguments(scenes, *case, folder, "1e-6"))
        theory = foretold(folder)["growth of the run"]
        steps = min(300, math.ceil(math.log(END / START) / math.log(theory))) if theory > 1 else 100
        scene_tools.run(program, arguments(scenes, *case, folder, f"{steps}*({case[1]})"))
        found = measured(folder)
    print(f"{name}: foretold {theory:.4f}, found {found:.4f} a step, after {steps} steps")
    return abs(found / theory - 1) <= ALLOWED


def check_ranks(program, scenes, case):
    """The same on two ranks."""
    with tempfile.TemporaryDirectory() as folder:
        results = []
        for ranks in (1, 2):
            scene_tools.run(program, arguments(scenes, *case, folder, "1e-6"), ranks)
            results.append(foretold(folder))
    return all(abs(results[1][key] / value - 1) < 1e-4 for key, value in results[0].items())


def check_what_is_refused(program, scenes):
    """No bodies in a fluid, an integrator of two stages; and a chamber, for which splitting has no solution."""
    ask = ["--set", "Output/Stability of splitting=true", "--set", "Time/End=1e-6"]
    for scene, settings, code, said in (("cavity", [], 2, "needs bodies in a fluid"),
                                        ("piston", [], 2, "Try 'Time / Integrator = theta'"),
                                        ("piston", ["--set", "Time/Integrator=static"], 2, "have inertia"),
                                        ("closed_chamber", ["--set", "Time/Integrator=theta"], 0, "close off a part")):
        with tempfile.TemporaryDirectory() as folder:
            found, printed, errors = scene_tools.ended(
                program, [os.path.join(scenes, scene + ".prm"), "--output", os.path.join(folder, "run"), *ask, *settings])
        if found != code or said not in printed + errors:
            sys.exit(f"check_linear_theory.py: {scene}: exit code {found}, not {code} with '{said}':\n{printed}{errors}")


def main():
    program, scenes = sys.argv[1:3]
    check_what_is_refused(program, scenes)
    if not check_ranks(program, scenes, CASES["theta, w"]):
        sys.exit("check_linear_theory.py: what is foretold depends on the number of ranks")
    wrong = [name for name, case in CASES.items() if not check(program, scenes, name, case)]
    if wrong:
        sys.exit(f"check_linear_theory.py: growth is not what linear theory foretells: {', '.join(wrong)}")


if __name__ == "__main__":
    main()
