#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What accuracy costs around a body that moves: the force on a cylinder that swings in a fluid at rest, against that on
the same cylinder at rest in a fluid that swings.

usage: benchmarks/oscillating_cylinder.py [PROGRAM] [--across 12]... [--step 1/100]... [--form flux]... [--check]

Both forces are the same, as the box repeats along the motion: the acceleration of the frame is a body force, and the
pressure of the program is that without its potential. Printed are the largest force and the difference of both, root mean
square in proportion to the largest force, with the force at the end of steps and with the rate of the impulse, its mean over
the steps before and after. Then the spikes of the pressure's force: the largest deviation from a cubic fitted to the seven
steps around, in proportion to the amplitude, of the force at the end of steps, of its mean over each step, and of the rate
of the impulse. Last the momentum that the fluid does not get of what the cylinder gives it from 0.5 to 1.5 s, in proportion
to what is exchanged. All over t >= 0.2 s. --check: exit code 1 if fluxes lose more than a hundredth where the cylinder, which
reaches 1 m/s, crosses less than a cell in a step. One rank; a minute with 12 cells across the cylinder, ten with 24.
"""
import argparse
import itertools
import os
import sys
from fractions import Fraction

import numpy

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, ROOT)
from study import quantities, runs, tables  # noqa: E402
from study.convergence import norm  # noqa: E402

SCENE = os.path.join(ROOT, "prm", "oscillating_cylinder.prm")
DIAMETER, LENGTH, HEIGHT = 0.2, 2.0, 1.0  # [m]
CUBIC = numpy.array([-2, 3, 6, 7, 6, 3, -2]) / 21  # the value in the middle of that fitted to seven points
AT_REST = {"Obstacles/cylinder/Displacement": "0; 0", "Effects/body force/Fluid/Acceleration": "-2*pi*cos(2*pi*t); 0"}
BOUND = 0.01
LATE = 0.2 - 1e-9  # [s]


def run(program, across, step, form, changes):
    """The result of a run and its columns."""
    result, columns = runs.single(program, SCENE, {
        "Domain/Cells": f"{round(LENGTH / DIAMETER * across)}, {round(HEIGHT / DIAMETER * across)}", "Time/Step": step,
        "Effects/convection/Form": form, "Output/Budget": "true", "Output/Impulses": "true",
        **changes})
    if result["failure"]:
        sys.exit(f"oscillating_cylinder.py: {result['failure']}")
    return result, columns


def along(columns, kind):
    """The force or impulse along the motion."""
    return columns[f"pressure {kind} cylinder x"] + columns[f"viscous {kind} cylinder x"]


def rate(columns):
    return quantities.rates(columns["Time"], along(columns, "impulse"))


def spikes(columns):
    """Of the pressure's force: at the end of steps, over steps, and over the steps before and after."""
    times, impulse = columns["Time"], columns["pressure impulse cylinder x"]
    forces = [(times, columns["pressure force cylinder x"]), (times[1:], numpy.diff(impulse) / numpy.diff(times)),
              (times[1:-1], quantities.rates(times, impulse)[1:-1])]
    return [largest_deviation(values[at > LATE]) for at, values in forces]


def largest_deviation(forces):
    return numpy.abs(forces[3:-3] - numpy.convolve(forces, CUBIC, "valid")).max() / numpy.ptp(forces) * 2


def momentum_lost(columns):
    """The difference of what the cylinder gives and of what the fluid gains."""
    times = columns["Time"][1:]
    given = -numpy.diff(along(columns, "impulse"))
    # The fluid gives back in the first half of this period what it gets in the second one.
    sign = numpy.where(times > 1 + 1e-9, 1, -1) * ((times > 0.5 + 1e-9) & (times < 1.5 + 1e-9))
    return numpy.sum(sign * (given - columns["momentum gain x"][1:])) / numpy.sum(sign * given)


def percents(values):
    return [f"{100 * value:.1f} %" for value in values]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--across", action="append", type=int)
    parser.add_argument("--step", action="append")
    parser.add_argument("--form", action="append", choices=("along paths", "flux"))
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    rows, judged = [], []
    for across, step, form in itertools.product(options.across or [6, 12], options.step or ["1/50", "1/100"],
                                                options.form or ["along paths", "flux"]):
        result, moving = run(options.program, across, step, form, {})
        _, fixed = run(options.program, across, step, form, AT_REST)
        late = moving["Time"] > LATE
        largest = numpy.abs(along(moving, "force")[late]).max()
        lost = momentum_lost(moving)
        if form == "flux" and Fraction(step) < DIAMETER / across:
            judged.append(abs(lost) <= BOUND)
        differences = [along(moving, "force") - along(fixed, "force"), rate(moving) - rate(fixed)]
        rows.append([across, step, form, f"{largest:.4f}", *percents(norm(each[late]) / largest for each in differences),
                     *percents(spikes(moving)), f"{100 * lost:+.1f} %", f"{result['core seconds']:.0f}"])
    print("\n".join(tables.table(["cells across", "step [s]", "form", "largest force [N/m]", "differs by", "rate differs by",
                                  "spikes, end", "mean", "rate", "momentum lost", "core seconds"], rows)))
    if options.check and not judged:
        sys.exit("oscillating_cylinder.py: none of these has a bound: of form 'flux', in steps of less than a cell")
    sys.exit(1 if options.check and not all(judged) else 0)


if __name__ == "__main__":
    main()
