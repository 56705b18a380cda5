#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What bodies that sleep cost: steps with one body, with three more that sleep, and with four awake.

usage: benchmarks/sleeping_bodies.py [PROGRAM] [--case NAME]... [--rounds N] [--check] [--profile]

One body vibrates; three equal ones rest beside it, without a fluid or in one. In '3D jet' it is the first sheet of
prm/jet_two_sheets.prm that swings; three stiff ones stand behind it. Prints a table: seconds of a processor per step
of the three runs; the share (1 + 3 asleep - 1) / (4 - 1) of what three bodies cost awake; and how far displacements of the run
with sleep are from those of the run without it, over the bound 2 V T of doc/effects.md. Steps are those after all three
have fallen asleep. Runs take turns from checkpoints, and of each step the fastest of the rounds counts: others that use
the machine make it slower, never faster. --check fails where displacements differ by more than 2 V T or where the share is
above that of the case. --profile prints seconds per step and phase instead, of runs one after the other. One rank; a round
of the jet takes two minutes.
"""
import argparse
import contextlib
import os
import re
import shutil
import statistics as medians
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "checks"))
import scene_tools  # noqa: E402

TIME = 0.25  # T [s]: half a period of the bodies
STEP = 0.02  # s
FIRST, LAST = 14, 34  # steps between which runs are compared: the three sleep after the thirteenth
PLACES = (0.3, 0.8, 1.2, 1.6)  # of the bodies [m]
JET_PLACES = (0.703, 1.087, 1.387, 1.687)  # of the sheets in the jet, which the first does not reach


@dataclass
class Case:
    """Bodies of which kind, in what, and the largest share that passes."""
    dimension: int
    cells: str  # of a body
    fluid: str  # cells of the grid; empty: no fluid
    bound: float
    scheme: str = "simultaneous"
    jet: bool = False
    speed: float = 1e-2  # V [m/s]


CASES = {
    "alone, 2D": Case(2, "8, 32", "", 0.05),
    "alone, 3D": Case(3, "2, 8, 4", "", 0.05),
    "in a fluid, 2D": Case(2, "8, 32", "80, 40", 0.05),
    "in a fluid, 3D": Case(3, "2, 8, 4", "40, 20, 12", 0.05),
    "3D jet": Case(3, "1, 10, 6", "48, 24, 24", 0.05, jet=True, speed=0.1),
    "3D jet, finer sheets": Case(3, "1, 16, 10", "48, 24, 24", 0.05, jet=True, speed=0.1),
    "time splitting, 2D": Case(2, "8, 32", "80, 40", 0.05, "time_splitting"),
}


def sheet(name, x, modulus, speed, cells):
    """A sheet in the way of the jet, as in prm/jet_two_sheets.prm."""
    return f"""
  subsection {name}
    set Shape           = box
    set Lower corner    = {x}, -0.05, 0.3
    set Upper corner    = {x + 0.02:.3f}, 0.6, 0.7
    set Cells           = {cells}
    set Density         = 1100
    set Young's modulus = {modulus}
    set Poisson's ratio = 0.3
    set Initial velocity = {speed} * max(0, y); 0; 0
    subsection Boundaries
      subsection foot
        set Where = -y
        set Kind  = clamp
      end
    end
  end"""


def body(name, x, speed, case):
    """A post on the ground."""
    depth = ("", "") if case.dimension == 2 else (", 0.2", ", 0.8")
    still = "; 0" if case.dimension == 2 else "; 0; 0"
    return f"""
  subsection {name}
    set Shape            = box
    set Lower corner     = {x}, -0.02{depth[0]}
    set Upper corner     = {x + 0.1}, 0.5{depth[1]}
    set Cells            = {case.cells}
    set Density          = 1000
    set Material         = neo-Hookean
    set Young's modulus  = 1e6
    set Poisson's ratio  = 0.3
    set Initial velocity = {speed} * max(0, y){still}
    subsection Boundaries
      subsection foot
        set Kind  = clamp
        set Sides = bottom
      end
    end
  end"""


def fluid(case):
    corner = "2, 1" if case.dimension == 2 else "2, 1, 1"
    return f"""
subsection Domain
  set Upper corner = {corner}
  set Cells        = {case.fluid}
end
subsection Fluid
  set Density = 1
  subsection Boundaries
    subsection above
      set Sides    = top
      set Kind     = pressure
      set Pressure = 0
    end
  end
end"""


def jet(case):
    return f"""
subsection Domain
  set Upper corner = 2, 1, 1
  set Cells        = {case.fluid}
end
subsection Fluid
  set Density = 1.2
  subsection Boundaries
    subsection jet
      set Sides    = left
      set Region   = 0.15^2 - (y - 0.58)^2 - (z - 0.5)^2
      set Kind     = inflow
      set Velocity = 6; 0; 0
    end
    subsection open
      set Sides = right, top, back, front
      set Kind  = outflow
    end
  end
end"""


def bodies_of(case, n_bodies):
    if case.jet:
        return "".join(sheet(f"body_{k}", x, *((1e6, 0.5) if k == 0 else (1e10, 0)), case.cells)
                       for k, x in enumerate(JET_PLACES[:n_bodies]))
    return "".join(body(f"body_{k}", x, 0.4 if k == 0 else 0.01, case) for k, x in enumerate(PLACES[:n_bodies]))


def scene(case, n_bodies, sleeps, probes=""):
    surroundings = jet(case) if case.jet else fluid(case) if case.fluid else ""
    effects = "subsection convection\nend\n" if case.fluid else ""
    if sleeps:
        effects += f"subsection sleep\n  set Speed = {case.speed}\n  set Time = {TIME}\nend\n"
    return f"""
set Dimension = {case.dimension}
set Scheme = {case.scheme}
subsection Time
  set End           = 100
  set Step          = {1 / 30 if case.jet else STEP}
  set Maximum steps = {LAST}
end
{surroundings}
subsection Bodies{bodies_of(case, n_bodies)}
end
subsection Effects
{effects}
end
subsection Probes
{probes}
end
subsection Output
  set Parts = statistics
end
"""


def probe(k, x, case):
    point = f"{x}, 0.5" if case.dimension == 2 else f"{x}, 0.5, 0.5"
    return f"subsection top_{k}\n  set Kind = body point\n  set Body = body_{k}\n  set Point = {point}\nend\n"


@dataclass
class Result:
    """What a run took and found."""
    phases: dict  # (level, name): seconds of the clock, summed over phases of a name
    columns: dict  # of `statistics`


def run(program, text, steps):
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "scene.prm")
        with open(name, "w", encoding="utf-8") as file:
            file.write(text)
        command = [program, name, "--output", folder + "/out", "--set", f"Time/Maximum steps={steps}"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(f"sleeping_bodies.py: {done.stdout[-800:]}{done.stderr[-800:]}")
        phases = {}
        with open(folder + "/out/timing", encoding="utf-8") as file:
            for line in file:
                found = re.match(r"( *)([a-z].*?)\s+(\d+)\s+([\d.]+)\s+[\d.]+\s*$", line)
                if found:
                    phase = (len(found[1]) // 2, found[2])
                    phases[phase] = phases.get(phase, 0) + float(found[4])
        names, _, rows = scene_tools.parse(scene_tools.statistics(folder + "/out"))
        columns = {column: [row[k] for row in rows] for k, column in enumerate(names)}
        return Result(phases, columns)


def phases_per_step(program, text):
    """Seconds by phase of a step: the difference of a long and a short run."""
    short, whole = run(program, text, FIRST), run(program, text, LAST)
    return {phase: (whole.phases[phase] - short.phases.get(phase, 0)) / (LAST - FIRST) for phase in whole.phases}


def started(program, text, folder):
    """Run a scene to step FIRST; the folder of its results, with a checkpoint."""
    os.makedirs(folder)
    with open(folder + "/scene.prm", "w", encoding="utf-8") as file:
        file.write(text)
    command = [program, folder + "/scene.prm", "--output", folder + "/out", "--set", f"Time/Maximum steps={FIRST}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"sleeping_bodies.py: {done.stdout[-800:]}{done.stderr[-800:]}")
    return folder + "/out"


def seconds_of_steps(program, start):
    """Seconds of a processor that each step takes from the second after a checkpoint to LAST."""
    with tempfile.TemporaryDirectory() as folder:
        out = shutil.copytree(start, folder + "/out")
        command = [program, "resume", out, "--set", f"Time/Maximum steps={LAST}"]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        ends, statistics, size = {}, out + "/statistics", 0
        while process.poll() is None:
            time.sleep(0.001)
            with contextlib.suppress(OSError), open(f"/proc/{process.pid}/schedstat", encoding="ascii") as stat:
                used = int(stat.read().split()[0]) * 1e-9
                if os.path.getsize(statistics) != size:
                    size = os.path.getsize(statistics)
                    with open(statistics, encoding="utf-8") as file:
                        steps = re.findall(r"^ *(\d+) .*\n", file.read(), re.MULTILINE)
                    if steps and int(steps[-1]) > FIRST:
                        ends.setdefault(int(steps[-1]), used)
        if process.returncode or not all(step in ends for step in range(FIRST + 1, LAST)):
            sys.exit(f"sleeping_bodies.py: a run ended with {process.returncode}, after {len(ends)} steps")
        return [ends[step] - ends[step - 1] for step in range(FIRST + 2, LAST)]


def seconds_per_step(program, texts, rounds):
    """Of each scene the mean over steps, each as fast as the fastest of the rounds, in which scenes take turns."""
    with tempfile.TemporaryDirectory() as folder:
        starts = [started(program, text, f"{folder}/{k}") for k, text in enumerate(texts)]
        found = [[seconds_of_steps(program, start) for start in starts] for _ in range(rounds)]
    return [medians.mean(map(min, zip(*(of_round[k] for of_round in found)))) for k in range(len(texts))]


def difference(program, case):
    """Largest difference of the bodies' tops, with sleep and without, over 2 V T."""
    probes = "".join(probe(k, x, case) for k, x in enumerate(JET_PLACES if case.jet else PLACES))
    with_sleep = run(program, scene(case, 4, True, probes), LAST).columns
    without = run(program, scene(case, 4, False, probes), LAST).columns
    largest = 0
    for name in without:
        if re.match(r"top_\d displacement", name):
            largest = max([largest] + [abs(a - b) for a, b in zip(with_sleep[name], without[name])])
    if any(with_sleep[f"asleep body_{k}"][FIRST] != 1 for k in (1, 2, 3)):
        sys.exit("sleeping_bodies.py: bodies that rest do not sleep")
    return largest / (2 * case.speed * TIME)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--case", action="append", choices=CASES)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--profile", action="store_true")
    options = parser.parse_args()
    failed = False
    if not options.profile:
        print("| case | 1 body [s] | 1 + 3 asleep [s] | 4 awake [s] | share | difference over 2 V T |")
        print("|---|---|---|---|---|---|")
    for name in options.case or CASES:
        case = CASES[name]
        texts = [scene(case, 1, False), scene(case, 4, True), scene(case, 4, False)]
        if options.profile:
            print_profile(name, [[phases_per_step(options.program, text) for text in texts] for _ in range(options.rounds)])
            continue
        one, asleep, four = seconds_per_step(options.program, texts, options.rounds)
        share, off = (asleep - one) / (four - one), difference(options.program, case)
        print(f"| {name} | {one:.4f} | {asleep:.4f} | {four:.4f} | {100 * share:.1f} % | {off:.2g} |", flush=True)
        failed |= share > case.bound or off > 1
    if options.check and failed:
        sys.exit("sleeping_bodies.py: a share or a difference is too large")


def print_profile(name, found):
    print(f"\n{name}: ms per step with 1 body, 1 + 3 asleep, 4 awake")
    for phase in found[0][2]:
        row = [1e3 * medians.median(of_round[k].get(phase, 0) for of_round in found) for k in range(3)]
        print(f"{'  ' * phase[0] + phase[1]:32}" + "".join(f"{value:10.3f}" for value in row))


if __name__ == "__main__":
    main()
