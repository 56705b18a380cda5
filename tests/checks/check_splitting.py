#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Light sheets: solved in turns with the fluid they shake, solved with it at the same steps they do not.
Heavy sheets: both ways agree, and twice as well with half the step.

usage: check_splitting.py PROGRAM SCENE.prm

Light sheets shake in two ways (doc/splitting.md, case C). With steps of 1/30 s both variants of splitting have far
more kinetic energy in each of the last steps than the simultaneous run ever has, until they stop or a sheet is thrown
through the floor. With steps of 1/480 s the energy grows from step to step, until no balance is found, an element is
inverted, the sheets seal off a part of the fluid or one is thrown through the floor, too; exit code, message and step
are those of this end and of no other.
"""
import os
import re
import sys
import tempfile

import scene_tools

HEAVY = [f"Bodies/{sheet}/{assignment}" for sheet in ("first", "second")
         for assignment in ("Density=12000", "Young's modulus=5e5")] + [
             "Fluid/Boundaries/jet/Velocity=0.5; 0"]
SCHEMES = {"simultaneous": ["Scheme=simultaneous"],
           "velocity": ["Scheme=time_splitting", "Coupling/Fluid driven by=velocity"],
           "displacement": ["Scheme=time_splitting", "Coupling/Fluid driven by=displacement"]}
STEP_FAILED, INPUT_FAILED = 3, 2  # exit codes
LONG, SHORT = 30, 480  # steps per second
SHAKING = 5  # at 1/30 s: times the largest energy of the simultaneous run; 11 and 24 are seen
GROWTH = 3  # at 1/480 s: factor of energy per step; 17 and 9.1 are seen
# The step that fails at 1/480 s, give or take two; those of long runs would depend on rounding.
LAST_STEP = {"velocity": 6, "displacement": 7}
SLACK = 2
THROWN = "passes the wall at side 'bottom'"
ENDS = ("Newton's method does not converge", "an element of a solid is inverted", "If bodies close this part off, time splitting has no solution")


def call(arguments, end, scheme, assignments):
    """Exit code, columns by name, and what was said of errors."""
    with tempfile.TemporaryDirectory() as folder:
        results = os.path.join(folder, "run")
        settings = SCHEMES[scheme] + assignments + [
            f"Time/End={end}", "Output/Interval=0", "Output/Parts=statistics"]
        words = [word for setting in settings for word in ("--set", setting)]
        code, printed, errors = scene_tools.ended(arguments[0], [arguments[1], "--output", results] + words)
        if not os.path.exists(os.path.join(results, "statistics")):
            sys.exit(f"{scheme}: exit code {code}\n{printed}\n{errors}")
        names, _, rows = scene_tools.parse(scene_tools.statistics(results))
        return code, dict(zip(names, zip(*rows))), errors


def run(arguments, end, scheme, assignments):
    """Columns of a run that reaches its end."""
    code, columns, errors = call(arguments, end, scheme, assignments)
    if code != 0:
        sys.exit(f"{scheme}, {assignments}: exit code {code}\n{errors}")
    return columns


def shaking(arguments):
    step = [f"Time/Step=1/{LONG}"]
    largest = max(run(arguments, 1, "simultaneous", step)["solid kinetic energy"])
    print(f"light sheets, 1/{LONG} s: at most {largest:.3g} J of kinetic energy")
    if not 0 < largest < 0.02:
        yield f"light sheets, simultaneous: {largest:.3g} J"
    for scheme in LAST_STEP:
        code, columns, errors = call(arguments, 1, scheme, step)
        energies = columns["solid kinetic energy"]
        least = min(energies[-len(energies) // 4:])
        print(f"  fluid driven by {scheme}: exit code {code} after {len(energies) - 1} steps, at least {least:.3g} J in "
              "the last quarter")
        is_thrown = code == INPUT_FAILED and THROWN in errors
        if not (code in (0, STEP_FAILED) or is_thrown) or (code == 0 and len(energies) != LONG + 1):
            yield f"light sheets, fluid driven by {scheme}: exit code {code} after {len(energies) - 1} steps\n{errors}"
        if not least > SHAKING * largest:
            yield f"light sheets, fluid driven by {scheme}: only {least:.3g} J after {len(energies) - 1} steps"


def growing(arguments):
    # How such a run ends would else depend on where Newton's method stops.
    step = [f"Time/Step=1/{SHORT}", "Solid numerics/Newton tolerance=1e-12"]
    largest = max(run(arguments, 0.05, "simultaneous", step)["solid kinetic energy"])
    print(f"light sheets, 1/{SHORT} s: at most {largest:.3g} J of kinetic energy")
    for scheme, last in LAST_STEP.items():
        code, columns, errors = call(arguments, 0.05, scheme, step)
        failed = re.search(r"^Error: step (\d+), which begins at", errors, re.M)
        energies = columns["solid kinetic energy"]
        moving = [energy for energy in energies if energy > 0]
        growth = (moving[-1] / moving[0]) ** (1 / max(1, len(moving) - 1))
        print(f"  fluid driven by {scheme}: exit code {code}, step {failed and failed[1]} fails, {moving[-1]:.3g} J, "
              f"{growth:.2f} times as much in each step")
        is_thrown = code == INPUT_FAILED and THROWN in errors
        if not failed or not (is_thrown or (code == STEP_FAILED and any(end in errors for end in ENDS))):
            yield f"light sheets, fluid driven by {scheme}: exit code {code}\n{errors}"
        elif abs(int(failed[1]) - last) > SLACK or len(energies) != int(failed[1]):
            yield (f"light sheets, fluid driven by {scheme}: step {failed[1]} of {len(energies)} fails, "
                   f"expected {last}")
        elif not (growth > GROWTH and moving[-1] > 1000 * largest):
            yield f"light sheets, fluid driven by {scheme}: fails without shaking, energies {energies}"


def heavy(arguments):
    found = []
    for per_second in (30, 60):
        step = [f"Time/Step=1/{per_second}"]
        one, other = (run(arguments, 2, scheme, HEAVY + step)["first_tip displacement x"]
                      for scheme in ("simultaneous", "velocity"))
        if not len(one) == len(other) == 2 * per_second + 1:
            yield f"heavy sheets: {len(one) - 1} and {len(other) - 1} steps at 1/{per_second} s"
        found.append(max(abs(a - b) for a, b in zip(one, other)) / max(map(abs, one)))
    print("heavy sheets: the tips differ by " + ", ".join(f"{value:.3%}" for value in found))
    if not found[0] <= 0.05:
        yield f"heavy sheets differ by {found[0]:.3%}"
    if not 1.7 * found[1] < found[0] < 2.3 * found[1]:
        yield f"heavy sheets differ by {found[0]:.3%}, with half the step by {found[1]:.3%}"


def main():
    arguments = sys.argv[1:3]
    found = list(shaking(arguments)) + list(growing(arguments)) + list(heavy(arguments))
    if found:
        sys.exit("\n".join(found))


main()
