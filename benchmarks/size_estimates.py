#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the program says beforehand of memory and seconds per step, against what its runs take:
every scene in prm/ and a ladder of sizes, as a Markdown table.

usage: benchmarks/size_estimates.py [PROGRAM] [--ladder | --scenes] [--match TEXT] [--steps N]

Memory is the sum over ranks of the largest resident set of each. Seconds are those of the phases of
a step without output, by the file `timing`. Factors are measured over estimated; those beyond what
the program promises are marked. The figures behind the estimates are in
include/undine/scene/cost_figures.h. Nothing else should run meanwhile.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "checks"))
import scene_tools  # noqa: E402

UNITS = {"kB": 1e3, "MB": 1e6, "GB": 1e9, "TB": 1e12, "s": 1, "min": 60, "h": 3600, "d": 86400}


def cells(*values):
    return [[f"Domain/Cells={value}"] for value in values]


# Scene, ranks, and what is set for each size.
LADDER = [
    ("prm/taylor_green.prm", 1, cells("128, 128", "512, 512", "1024, 1024")),
    ("prm/cavity.prm", 1, cells("128, 128", "256, 256", "512, 512")),
    ("prm/plume.prm", 1, cells("32, 64, 32", "50, 100, 50", "80, 156, 80")),
    ("prm/plume.prm", 2, cells("32, 64, 32", "50, 100, 50", "80, 156, 80")),
    ("prm/ball_in_stream.prm", 1, cells("60, 40, 40", "96, 64, 64", "150, 80, 80")),
    ("prm/cantilever.prm", 1, [[f"Bodies/beam/Cells={cells}"]
                               for cells in ("20, 2, 4", "32, 4, 6", "48, 6, 10")]),
    ("prm/jet_two_sheets.prm", 1,
     [[f"Domain/Cells={grid}", f"Bodies/first/Cells={sheet}", f"Bodies/second/Cells={sheet}"]
      for grid, sheet in (("24, 12, 12", "1, 7, 4"), ("48, 24, 24", "1, 13, 8"),
                          ("72, 36, 36", "1, 20, 12"))]),
    ("prm/dam_break_particles.prm", 1,
     [[f"Particles/Spacing=0.146/{n}"] for n in (24, 72, 144)]),
    ("prm/dam_break_impact_particles_3d.prm", 1,
     [[f"Particles/Spacing={spacing}", "Domain/Upper corner=1.62, 0.6, 0.15"]
      for spacing in ("0.03", "0.015", "0.0075")]),
]


def estimated(program, scene, settings, ranks):
    """Memory [bytes] and seconds a step that the program expects."""
    arguments = [str(ROOT / scene), "--validate"]
    for setting in settings:
        arguments += ["--set", setting]
    text = scene_tools.run(program, arguments, ranks).stdout
    found = re.search(r"^estimate: ([\d.]+) (\w+) of memory .*?, ([\d.e+-]+) (\w+) a step", text, re.M)
    return float(found[1]) * UNITS[found[2]], float(found[3]) * UNITS[found[4]]


def processes_below(process):
    """It and all that it has started, as far as they are still there."""
    yield process
    try:
        for task in os.listdir(f"/proc/{process}/task"):
            with open(f"/proc/{process}/task/{task}/children") as children:
                for child in children.read().split():
                    yield from processes_below(int(child))
    except OSError:
        return


class PeakMemory(threading.Thread):
    """The largest resident set of each process called `name` below another one [bytes]."""

    def __init__(self, process, name):
        super().__init__()
        self.process, self.name, self.peaks = process, name, {}

    def run(self):
        while self.process.poll() is None:
            for number in list(processes_below(self.process.pid)):
                self.look_at(number)
            time.sleep(0.02)

    def look_at(self, number):
        try:
            with open(f"/proc/{number}/status") as file:
                status = dict(line.split(":", 1) for line in file.read().splitlines())
        except OSError:
            return
        if status["Name"].strip() == self.name and "VmHWM" in status:
            self.peaks[number] = 1024 * float(status["VmHWM"].split()[0])


def measured(program, scene, settings, ranks, steps):
    """Memory [bytes] and seconds a step of a run."""
    with tempfile.TemporaryDirectory() as folder:
        arguments = [str(ROOT / scene), "--output", folder]
        for setting in list(settings) + [f"Time/Maximum steps={steps}"]:
            arguments += ["--set", setting]
        process = subprocess.Popen(scene_tools.command(program, arguments, ranks),
                                   env=scene_tools.environment(), stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
        memory = PeakMemory(process, os.path.basename(program))
        memory.start()
        text = process.communicate()[0]
        memory.join()
        if process.returncode != 0:
            raise RuntimeError(f"{scene} {settings}: exit code {process.returncode}\n{text[-1000:]}")
        seconds = 0
        for line in (pathlib.Path(folder) / "timing").read_text().splitlines():
            row = re.match(r"(\S.*?) +(\d+) +([\d.]+) +([\d.]+)$", line)
            if row and row[1] not in ("initialise", "output"):
                seconds += float(row[3])
    return sum(memory.peaks.values()), seconds / steps


def row(program, scene, settings, ranks, steps):
    memory, seconds = estimated(program, scene, settings, ranks)
    memory_used, seconds_used = measured(program, scene, settings, ranks, steps)
    factors = memory_used / memory, seconds_used / seconds
    marks = ["" if 1 / most <= factor <= most else " !" for factor, most in zip(factors, (1.5, 3))]
    print(f"| {scene} {' '.join(settings)} | {ranks} | {memory / 1e6:.0f} | {memory_used / 1e6:.0f} "
          f"| {factors[0]:.2f}{marks[0]} | {seconds:.3g} | {seconds_used:.3g} "
          f"| {factors[1]:.2f}{marks[1]} |", flush=True)
    return factors


def cases(arguments):
    if not arguments.ladder:
        for scene in sorted((ROOT / "prm").glob("*.prm")):
            yield f"prm/{scene.name}", [], 1
    if not arguments.scenes:
        for scene, ranks, values in LADDER:
            for settings in values:
                yield scene, settings, ranks


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", nargs="?", default=str(ROOT / "build" / "undine"))
    parser.add_argument("--ladder", action="store_true", help="the ladder of sizes alone")
    parser.add_argument("--scenes", action="store_true", help="the scenes of prm/ alone")
    parser.add_argument("--match", default="", help="scenes whose name contains it")
    parser.add_argument("--steps", type=int, default=5)
    arguments = parser.parse_args()
    print("| scene | ranks | MB estimated | measured | factor | s a step estimated | measured "
          "| factor |\n|---|---|---|---|---|---|---|---|")
    all_factors = [row(arguments.program, *case, arguments.steps) for case in cases(arguments)
                   if arguments.match in case[0]]
    for name, column, most in (("memory", 0, 1.5), ("seconds", 1, 3)):
        outside = sum(not 1 / most <= factors[column] <= most for factors in all_factors)
        print(f"\n{name}: {outside} of {len(all_factors)} beyond a factor of {most}")


main()
