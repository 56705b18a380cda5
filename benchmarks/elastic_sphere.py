#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The elastic ball of prm/elastic_sphere.prm for some density ratios and stiffnesses: is it stable, does it keep its
volume, does the energy fall, does water get into it, and how many frames a second does it take?

usage: benchmarks/elastic_sphere.py [--program PROGRAM] [--executor host|device] [--end SECONDS] [--set SECTION/KEY=VALUE]...

Prints one row for each case: frames (of the scene's step) per wall second, all of the run included; least and largest
volume over that at rest, and what it settles to; the largest rise of the total energy above its start [J]; most
particles of water in the ball; sub-steps a frame; iterations of the pressure solver a sub-step. A case that stops says why.
"""
import argparse
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "checks"))
import scene_tools  # noqa: E402

CASES = [(ratio, modulus, 0.49) for ratio in (0.5, 1.2, 2.0) for modulus in (1e4, 1e5, 1e6)] + \
        [(ratio, 1e6, 0.3) for ratio in (0.5, 1.2, 2.0)]
ENERGIES = ("Kinetic energy of fluid", "Kinetic energy of bodies", "Potential energy", "Elastic energy")


def settings(case, arguments):
    ratio, modulus, poisson = case
    return [f"Bodies/ball/Density={1000 * ratio}", f"Bodies/ball/Young's modulus={modulus}",
            f"Bodies/ball/Poisson's ratio={poisson}", f"Particles/Executor={arguments.executor}",
            f"Time/End={arguments.end}", "Output/Parts=statistics"] + arguments.set


def run(case, arguments):
    scene = os.path.join(ROOT, "prm", "elastic_sphere.prm")
    return scene_tools.timed_columns(arguments.program, scene, settings(case, arguments))


def describe(case, columns, seconds):
    frames = len(columns["Step"]) - 1
    volume = columns["Volume of ball over that at rest"]
    energy = [sum(terms) for terms in zip(*(columns[name] for name in ENERGIES))]
    sub_steps = sum(columns["Sub-steps"])
    return (f"{case[0]:5.1f} {case[1]:8.0e} {case[2]:5.2f} {frames / seconds:9.1f} "
            f"{min(volume):8.4f} {max(volume):8.4f} {sum(volume[-100:]) / len(volume[-100:]):8.4f} "
            f"{max(energy) - energy[0]:11.3e} {int(max(columns['Fluid particles in bodies'])):6d} "
            f"{sub_steps / frames:9.1f} {sum(columns['Linear iterations']) / sub_steps:11.1f}")


def reason(error):
    lines = [line for line in str(error).splitlines() if line.strip()]
    return ([line for line in lines if line.startswith("Error")] + lines[-1:])[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--executor", default="host")
    parser.add_argument("--end", type=float, default=10)
    parser.add_argument("--set", action="append", default=[])
    arguments = parser.parse_args()
    print("ratio  modulus    nu  frames/s  least V   most V    V end  energy rise inside  sub-steps  iterations")
    for case in CASES:
        try:
            print(describe(case, *run(case, arguments)), flush=True)
        except RuntimeError as error:
            print(f"{case[0]:5.1f} {case[1]:8.0e} {case[2]:5.2f}  stopped: {reason(error)}", flush=True)


if __name__ == "__main__":
    main()
