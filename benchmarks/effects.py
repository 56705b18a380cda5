#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What effects cost, and that absent ones cost nothing, as Markdown tables (doc/costs_of_effects.md holds those of
one machine):

- each effect's share of a step of the jet against two sheets in 3D;
- smoke advected only where there is any, for plumes that fill a part of the domain;
- with --without, two programs in turns on the jet: PROGRAM, and one built without the files of effects that the
  scene does not call for (source/effects/NAME.cc).

usage: benchmarks/effects.py [PROGRAM] [--without OTHER_PROGRAM]

One rank. Seconds are those of the processor where two programs are compared.
"""
import argparse
import json
import math
import os
import resource
import statistics
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "checks"))
import scene_tools  # noqa: E402

JET = os.path.join(ROOT, "prm", "jet_two_sheets.prm")
PLUME = os.path.join(ROOT, "prm", "plume.prm")
NO_FILES = ["Output/Interval=0", "Output/Parts=statistics"]
STEPS_OF_JET = 30
ROUNDS = 10
STEPS_OF_COMPARISON = 3

HEIGHT = 1.6  # of the plume [m] in a box of 1 m x 2 m x 1 m
FILLS = (0.01, 0.02, 0.05, 0.1, 0.2)
GRIDS = ("32, 64, 32", "64, 128, 64", "96, 192, 96")
NEGLECTED = "1e-6"  # the default
STEPS_OF_PLUME = 3


def run(program, scene, settings):
    """The folder's effects.json, seconds of the steps by the clock, and of the processor for all."""
    with tempfile.TemporaryDirectory() as folder:
        arguments = [scene, "--output", folder]
        for setting in settings + NO_FILES:
            arguments += ["--set", setting]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        scene_tools.run(program, arguments)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        with open(os.path.join(folder, "effects.json")) as file:
            effects = json.load(file)
        with open(os.path.join(folder, "timing")) as file:
            seconds = sum(float(line.split()[-2]) for line in file
                          if line[0].isalpha() and line.split()[-1].replace(".", "").isdigit()
                          and not line.startswith("initialise"))
    return effects, seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def shares(program):
    """Of every effect in a step of the jet."""
    effects, seconds, _ = run(program, JET, [f"Time/Maximum steps={STEPS_OF_JET}"])
    print(f"## Shares of a step\n\nFirst {STEPS_OF_JET} steps of `prm/jet_two_sheets.prm`, {seconds / STEPS_OF_JET:.2f} s "
          "each. Effects that share phases show the seconds of all of these; the others' add up to less than a step, "
          "whose rest no effect calls for.\n")
    print("| effect | calls | % of the step | largest memory [MB] |\n|---|---|---|---|")
    for effect in sorted(effects["effects"], key=lambda effect: -effect["seconds"]):
        if effect["on"]:
            print(f"| {effect['name']} | {effect['calls']} | {100 * effect['seconds'] / seconds:.1f} "
                  f"| {effect['peak bytes'] / 1e6:.2f} |")
    off = [effect for effect in effects["effects"] if not effect["on"]]
    print(f"| off: {', '.join(effect['name'] for effect in off)} | {sum(effect['calls'] for effect in off)} "
          f"| {sum(effect['seconds'] for effect in off):g} | {sum(effect['peak bytes'] for effect in off):g} |")


def plume(fill, grid, neglected):
    """Hot smoke that rises around the middle, at the start exactly in this share of the box."""
    radius = math.sqrt(fill * 2 / (math.pi * HEIGHT))
    from_axis = f"((x-0.5)^2+(z-0.5)^2)/{radius:.6g}^2"
    smoke = f"max(0,1-{from_axis})^2*max(0,1-(y/{HEIGHT})^8)"
    section = "Effects/scalar transport"
    return [f"Domain/Cells={grid}", f"Time/Maximum steps={STEPS_OF_PLUME}", "Output/Budget=false",
            f"Fluid/Initial velocity=0; 0.5*exp(-{from_axis}); 0",
            f"{section}/smoke/Initial value={smoke}", f"{section}/smoke/Source=0",
            f"{section}/temperature/Initial value=293+40*{smoke}", f"{section}/temperature/Source=0",
            f"{section}/smoke/Neglected variation={neglected}", f"{section}/temperature/Neglected variation={neglected}"]


def cost_of_smoke(program, fill, grid, neglected):
    """Seconds of the transport of scalars in a step."""
    effects, _, _ = run(program, PLUME, plume(fill, grid, neglected))
    return sum(effect["seconds"] for effect in effects["effects"]
               if effect["name"] == "scalar transport") / STEPS_OF_PLUME


def plumes(program):
    print("\n## Smoke where there is any\n\nA plume in a box of 1 m x 2 m x 1 m, two scalars: seconds of their transport in "
          f"a step ({STEPS_OF_PLUME} steps), and the share of those that advecting them everywhere takes (`Neglected variation = 0`).\n")
    print("| cells | everywhere | " + " | ".join(f"{100 * fill:g} % filled" for fill in FILLS) + " |")
    print("|---" * (len(FILLS) + 2) + "|")
    for grid in GRIDS:
        whole = cost_of_smoke(program, FILLS[0], grid, "0")
        costs = [cost_of_smoke(program, fill, grid, NEGLECTED) for fill in FILLS]
        print(f"| {grid} | {whole:.3f} | " + " | ".join(f"{cost:.3f}, {100 * cost / whole:.0f} %" for cost in costs) + " |")
        sys.stdout.flush()


def in_turns(programs):
    """Seconds of the processor of each program, which run one after the other."""
    seconds = {name: [] for name in programs}
    for _ in range(ROUNDS):
        for name, program in programs.items():
            seconds[name].append(run(program, JET, [f"Time/Maximum steps={STEPS_OF_COMPARISON}"])[2])
    return seconds


def comparison(program, other):
    seconds = in_turns({"all files": program, "only files of effects that are on": other})
    print(f"\n## With and without the files of effects that are off\n\n{STEPS_OF_COMPARISON} steps of "
          f"`prm/jet_two_sheets.prm`, {ROUNDS} runs of each program in turns; seconds of the processor.\n")
    print("| program | median | quartiles |\n|---|---|---|")
    for name, values in seconds.items():
        first, _, third = statistics.quantiles(values, n=4)
        print(f"| {name} | {statistics.median(values):.2f} | {first:.2f} to {third:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--without", metavar="OTHER_PROGRAM")
    options = parser.parse_args()
    shares(options.program)
    plumes(options.program)
    if options.without:
        comparison(options.program, options.without)


main()
