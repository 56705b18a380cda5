#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What accuracy costs around a body that moves: the force on a cylinder that swings in a fluid at rest, against that on
the same cylinder at rest in a fluid that swings.

usage: benchmarks/oscillating_cylinder.py [PROGRAM] [--across 12]... [--step 1/100]... [--form flux]... [--check]

Both forces are the same, as the box repeats along the motion: the acceleration of the frame is a body force, and the
pressure of the program is that without its potential. Printed are the largest force, the difference of both and the
deviation of the force from a parabola through seven steps (spikes), root mean squares over t >= 0.2 s in proportion to
the largest force, and the momentum that the fluid does not get of what the cylinder gives it from 0.5 to 1.5 s, in
proportion to what is exchanged. --check: exit code 1 if fluxes lose more than a hundredth. One rank; a minute with 12
cells across the cylinder, ten with 24.
"""
import math
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "tests", "checks"), os.path.join(ROOT, "benchmarks")]
import convection_arguments  # noqa: E402
import time_integration  # noqa: E402

SCENE = os.path.join(ROOT, "prm", "oscillating_cylinder.prm")
DIAMETER, LENGTH, HEIGHT = 0.2, 2.0, 1.0  # [m]
PARABOLA = [-2, 3, 6, 7, 6, 3, -2]  # of 21: the value in the middle of that fitted to seven points
BOUND = 0.01


def run(program, across, step, form, moves):
    settings = [f"Domain/Cells={round(LENGTH / DIAMETER * across)}, {round(HEIGHT / DIAMETER * across)}",
                f"Time/Step={step}", f"Effects/convection/Form={form}", "Output/Parts=statistics",
                "Output/Budget=true"]
    if not moves:
        settings += ["Obstacles/cylinder/Displacement=0; 0",
                     "Effects/body force/Fluid/Acceleration=-2*pi*cos(2*pi*t); 0"]
    result = time_integration.once(program, SCENE, settings)
    if result.complaint:
        sys.exit(f"oscillating_cylinder.py: {result.complaint}")
    return result


def force(columns):
    return [sum(values) for values in zip(columns["pressure force cylinder x"], columns["viscous force cylinder x"])]


def root_mean_square(values):
    return math.sqrt(sum(value * value for value in values) / len(values))


def spikes(forces):
    return [forces[i] - sum(a * b for a, b in zip(PARABOLA, forces[i - 3:i + 4])) / 21
            for i in range(3, len(forces) - 3)]


def momentum_lost(columns):
    """The difference of an impulse by the trapezoidal rule, and of what the fluid gains."""
    times, forces, lost, exchanged = columns["Time"], force(columns), 0, 0
    for i in range(1, len(times)):
        if 0.5 + 1e-9 < times[i] < 1.5 + 1e-9:
            given = -(forces[i] + forces[i - 1]) / 2 * (times[i] - times[i - 1])
            # The fluid gives back in the first half of this period what it gets in the second one.
            sign = 1 if times[i] > 1 + 1e-9 else -1
            lost += sign * (given - columns["momentum gain x"][i])
            exchanged += sign * given
    return lost / exchanged


def main():
    options = convection_arguments.parser(__doc__).parse_args()
    failed = False
    print("| cells across | step [s] | form | largest force [N/m] | differs by | spikes | momentum lost | core seconds |")
    print("|---|---|---|---|---|---|---|---|")
    for across in options.across or [6, 12]:
        for step in options.step or ["1/50", "1/100"]:
            for form in options.form or ["along paths", "flux"]:
                moving = run(options.program, across, step, form, True)
                fixed = run(options.program, across, step, form, False)
                late = [i for i, time in enumerate(moving.columns["Time"]) if time > 0.2 - 1e-9]
                forces = [force(moving.columns)[i] for i in late]
                others = [force(fixed.columns)[i] for i in late]
                largest = max(abs(value) for value in forces)
                differs = root_mean_square([a - b for a, b in zip(forces, others)]) / largest
                lost = momentum_lost(moving.columns)
                failed = failed or (form == "flux" and abs(lost) > BOUND)
                print(f"| {across} | {step} | {form} | {largest:.4f} | {100 * differs:.1f} % | "
                      f"{100 * root_mean_square(spikes(forces)) / largest:.1f} % | {100 * lost:+.1f} % | "
                      f"{moving.seconds:.0f} |", flush=True)
    sys.exit(1 if options.check and failed else 0)


if __name__ == "__main__":
    main()
