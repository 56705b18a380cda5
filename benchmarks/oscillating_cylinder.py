#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What accuracy costs around a body that moves: the force on a cylinder that swings in a fluid at rest, against that on
the same cylinder at rest in a fluid that swings.

usage: benchmarks/oscillating_cylinder.py [PROGRAM] [--across 12]... [--step 1/100]... [--form flux]... [--check]

Both forces are the same, as the box repeats along the motion: the acceleration of the frame is a body force, and the
pressure of the program is that without its potential. Printed are the largest force, the difference of both and the
deviation from a parabola through seven steps (spikes), of the force at the end of steps and of its mean over each step,
which is what would move a free body, root mean squares over t >= 0.2 s in proportion to the largest force, and the
momentum that the fluid does not get of what the cylinder gives it from 0.5 to 1.5 s, in proportion to what is exchanged.
--check: exit code 1 if fluxes lose more than a hundredth. One rank; a minute with 12 cells across the cylinder, ten
with 24.
"""
import argparse
import itertools
import os
import sys

import numpy

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, ROOT)
from study import runs, tables  # noqa: E402
from study.convergence import norm  # noqa: E402

SCENE = os.path.join(ROOT, "prm", "oscillating_cylinder.prm")
DIAMETER, LENGTH, HEIGHT = 0.2, 2.0, 1.0  # [m]
PARABOLA = numpy.array([-2, 3, 6, 7, 6, 3, -2]) / 21  # the value in the middle of that fitted to seven points
AT_REST = {"Obstacles/cylinder/Displacement": "0; 0", "Effects/body force/Fluid/Acceleration": "-2*pi*cos(2*pi*t); 0"}
BOUND = 0.01


def run(program, across, step, form, changes):
    """The result of a run, its columns, and the force along the motion."""
    result, columns = runs.single(program, SCENE, {
        "Domain/Cells": f"{round(LENGTH / DIAMETER * across)}, {round(HEIGHT / DIAMETER * across)}", "Time/Step": step,
        "Effects/convection/Form": form, "Output/Budget": "true", **changes})
    if result["failure"]:
        sys.exit(f"oscillating_cylinder.py: {result['failure']}")
    return result, columns, columns["pressure force cylinder x"] + columns["viscous force cylinder x"]


def spikes(forces):
    """Deviations from a parabola through seven steps."""
    return forces[3:-3] - numpy.convolve(forces, PARABOLA, "valid")


def momentum_lost(columns, force):
    """The difference of an impulse by the trapezoidal rule, and of what the fluid gains."""
    times = columns["Time"][1:]
    given = -(force[1:] + force[:-1]) / 2 * numpy.diff(columns["Time"])
    # The fluid gives back in the first half of this period what it gets in the second one.
    sign = numpy.where(times > 1 + 1e-9, 1, -1) * ((times > 0.5 + 1e-9) & (times < 1.5 + 1e-9))
    return numpy.sum(sign * (given - columns["momentum gain x"][1:])) / numpy.sum(sign * given)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--across", action="append", type=int)
    parser.add_argument("--step", action="append")
    parser.add_argument("--form", action="append", choices=("along paths", "flux"))
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    rows, failed = [], False
    for across, step, form in itertools.product(options.across or [6, 12], options.step or ["1/50", "1/100"],
                                                options.form or ["along paths", "flux"]):
        result, columns, moving = run(options.program, across, step, form, {})
        _, _, fixed = run(options.program, across, step, form, AT_REST)
        late = columns["Time"] > 0.2 - 1e-9
        largest = numpy.abs(moving[late]).max()
        mean = -columns["momentum gain x"][1:] / numpy.diff(columns["Time"])  # over each step: the impulse of the fluid
        lost = momentum_lost(columns, moving)
        failed = failed or (form == "flux" and abs(lost) > BOUND)
        rows.append([across, step, form, f"{largest:.4f}", f"{100 * norm(moving[late] - fixed[late]) / largest:.1f} %",
                     f"{100 * norm(spikes(moving[late])) / largest:.1f} %",
                     f"{100 * norm(spikes(mean[late[1:]])) / largest:.1f} %", f"{100 * lost:+.1f} %",
                     f"{result['core seconds']:.0f}"])
    print("\n".join(tables.table(["cells across", "step [s]", "form", "largest force [N/m]", "differs by", "spikes",
                                  "of the mean", "momentum lost", "core seconds"], rows)))
    sys.exit(1 if options.check and failed else 0)


if __name__ == "__main__":
    main()
