#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which density of the fluid splitting can bear before the bar of prm/piston.prm, by linear theory: the spectral radius of
(V14) in doc/hard_cases.md. prm/studies/stability_piston.prm finds the same by runs.

usage: benchmarks/splitting_limits.py [--elements 8] [--theta 0.6]
"""
import argparse

import numpy

DENSITY, MODULUS, BAR, WATER = 100.0, 2e4, 0.5, 0.5  # of prm/piston.prm [kg/m3], [Pa], lengths [m]
STEPS = (1 / 50, 1 / 100, 1 / 200, 1 / 400)


def bar(n_elements):
    """Mass and stiffness of linear elements along the bar, whose first node is held, per area."""
    size = BAR / n_elements
    mass, stiffness = numpy.zeros((2, n_elements + 1, n_elements + 1))
    for first in range(n_elements):
        nodes = numpy.ix_((first, first + 1), (first, first + 1))
        mass[nodes] += DENSITY * size / 6 * numpy.array([[2, 1], [1, 2]])
        stiffness[nodes] += MODULUS / size * numpy.array([[1, -1], [-1, 1]])
    return mass[1:, 1:], stiffness[1:, 1:]


def spectral_radius(n_elements, step, theta, driven_by, density):
    """Of a step, which takes displacement, velocity and the last two velocities of the surface to the next ones."""
    mass, stiffness = bar(n_elements)
    one, zero = numpy.eye(len(mass)), numpy.zeros_like(mass)
    added = zero.copy()
    added[-1, -1] = density * WATER
    solve = numpy.linalg.inv(mass / step + theta ** 2 * step * stiffness)
    velocity = [-solve @ stiffness, solve @ (mass / step - theta * (1 - theta) * step * stiffness), -solve @ added / step,
                solve @ added / step]
    displacement = [step * theta * each for each in velocity]
    displacement[0] = displacement[0] + one
    displacement[1] = displacement[1] + step * (1 - theta) * one
    surface = list(velocity)
    if driven_by == "displacement":
        surface = [each / step for each in displacement]
        surface[0] = surface[0] - one / step
    step_matrix = numpy.block([displacement, velocity, surface, [zero, zero, one, zero]])
    return abs(numpy.linalg.eigvals(step_matrix)).max()


def limit(*case):
    """The largest density with which nothing grows [kg/m3]."""
    low, high = 1e-3, 1e5
    while high > 1.0001 * low:
        middle = (low * high) ** 0.5
        low, high = (middle, high) if spectral_radius(*case, middle) <= 1 + 1e-6 else (low, middle)
    return low


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--elements", type=int, action="append")
    parser.add_argument("--theta", type=float, default=0.6)
    options = parser.parse_args()
    print("| fluid driven by | elements | " + " | ".join(f"1/{1 / step:.0f} s" for step in STEPS) + " |\n" + "|---" * 6 + "|")
    for driven_by in ("velocity", "displacement"):
        for n_elements in options.elements or (8, 32):
            limits = (f"{limit(n_elements, step, options.theta, driven_by):.3g}" for step in STEPS)
            print(f"| {driven_by} | {n_elements} | {' | '.join(limits)} |")


if __name__ == "__main__":
    main()
