#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which integrator reaches which accuracy at which cost: error against core seconds for every integrator, every
setting of Newton's method and every step, in five cases.

usage: benchmarks/time_integration.py [PROGRAM] [--out DIR] [--case NAME]... [--integrator NAME]... [--quick]
       [--jobs N] [--repeats N]

Writes time_integration.md (tables), time_integration.csv (every run) and time_integration_CASE.png to DIR (default:
.), and prints orders and the cheapest runs; doc/time_integration.md says how errors are taken and what one machine
gave. --quick takes the three longest steps of each case, and Newton's method to the end alone.
Needs the Debian package python3-matplotlib. One rank a run, --jobs runs at a time: about a quarter of an hour with two.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "tests", "checks"), os.path.join(ROOT, "benchmarks")]
import accuracy  # noqa: E402
import scene_tools  # noqa: E402
import time_integration_report as report  # noqa: E402

INTEGRATOR_KEY = "Time/Integrator"
NUMBERS_SECTION = "Time"  # of an integrator's own numbers
NEWTON_SECTION = "Solid numerics"
QUICK_STEPS = 3  # as many as an own order takes
ENOUGH = 2  # seconds after which a run is not repeated


@dataclass
class Integrator:
    """How it is chosen, and at which share of a step the pressure belongs that a step ends with: the impulse h p
    acts over the whole step, on average at its middle."""
    kind: str
    numbers: dict = field(default_factory=dict)
    pressure_at: float = 0.5

    def settings(self):
        return [f"{INTEGRATOR_KEY}={self.kind}"] + [f"{NUMBERS_SECTION}/{key}={value}"
                                                    for key, value in self.numbers.items()]


INTEGRATORS = {
    "trapezoid_bdf2": Integrator("trapezoid_bdf2", pressure_at=1),  # of the stage that ends the step
    "theta 1/2": Integrator("theta", {"Theta": 0.5}),
    "theta 0.6": Integrator("theta", {"Theta": 0.6}),
    "theta 1": Integrator("theta", {"Theta": 1}),
    "newmark 1/2": Integrator("newmark", {"Gamma": 0.5}),
    "newmark 1": Integrator("newmark", {"Gamma": 1}),
    "alpha 0": Integrator("generalised_alpha", {"Spectral radius": 0}),
    "alpha 0.5": Integrator("generalised_alpha", {"Spectral radius": 0.5}),
    "alpha 0.8": Integrator("generalised_alpha", {"Spectral radius": 0.8}),
}
REFERENCES = ("trapezoid_bdf2", "newmark 1/2")  # the first one that the program knows
FINER = 8  # steps of the reference in the shortest of the others
NEWTON = {"1e-10": ["Newton tolerance=1e-10"], "1e-4": ["Newton tolerance=1e-4"],
          "once": ["Newton iterations=1"]}
TO_THE_END = "1e-10"


@dataclass
class Case:
    """A scene, what is changed in it, the columns of each quantity, and steps per second."""
    title: str
    scene: str
    end: float
    quantities: dict
    steps: tuple
    settings: tuple = ()


def point(name, axis, body=None):
    """Columns of a probe, and of the force of the pressure on a body."""
    result = {"displacement": f"{name} displacement {axis}", "velocity": f"{name} velocity {axis}"}
    return {**result, "pressure": f"pressure force {body} {axis}"} if body else result


def swing(amplitude):
    """The lowest mode of the bar with the water before it, so that nothing but it swings."""
    return (f"Bodies/bar/Initial displacement={amplitude}*sin(0.6221*x)/sin(0.31105); 0",)


CASES = {
    "piston": Case("a swing of a third of a cell", "prm/piston.prm", 0.75, point("tip", "x", "bar"),
                   (32, 64, 128, 256, 512), swing(0.01)),
    "far_piston": Case("a swing through three cells to either side", "prm/piston.prm", 0.75, point("tip", "x", "bar"),
                       (32, 64, 128, 256, 512), swing(0.1)),
    "pushed_piston": Case("a force that grows smoothly pushes it through four cells", "prm/piston.prm", 0.75,
                          point("tip", "x", "bar"), (32, 64, 128, 256, 512),
                          ("Bodies/bar/Initial displacement=0; 0",
                           "Effects/body force/Bodies/bar/Acceleration=30*(1-cos(8*t))^2; 0")),
    "plate": Case("water falls on a plate with a tenth of the scene's damping", "prm/hydrostatic_plate.prm", 0.5,
                  point("middle", "y", "plate"), (64, 128, 256, 512, 1024),
                  ("Effects/damping/Stiffness coefficient=0.002",)),
    "jet": Case("the first sheet in the jet", "prm/jet_two_sheets_2d.prm", 1, point("first_tip", "x", "first"),
                (32, 64, 128, 256), ("Output/Budget=false",)),
    "csm3": Case("a flag alone, without damping", "prm/turek_hron_csm3.prm", 1, point("A", "y"),
                 (16, 32, 64, 128)),
}


@dataclass
class Run:
    """Columns of a run by name, core seconds of its steps, and why it stopped if it did."""
    columns: dict
    seconds: float
    complaint: str

    def until(self):
        return self.columns["Time"][-1]

    def corrections(self):
        """Of Newton's method in all steps: what it costs, whoever else uses the machine."""
        return round(sum(self.columns["Newton iterations"]))

    def series(self, case, quantity, integrator):
        """Of a quantity at the times that it belongs to."""
        times, values = self.columns["Time"], self.columns[case.quantities[quantity]]
        share = INTEGRATORS[integrator].pressure_at if quantity == "pressure" else 1
        return accuracy.series_of_mean(times, values, share)


def neutral_scene(scene, folder):
    """The path of a copy without integrator, since the numbers of another one would be unknown keys."""
    numbers = {key for integrator in INTEGRATORS.values() for key in integrator.numbers}
    chosen = "|".join(map(re.escape, numbers | {INTEGRATOR_KEY.split("/")[-1]}))
    with open(scene) as file:
        text = re.sub(rf"^\s*set ({chosen})\s*=.*\n", "", file.read(), flags=re.M)
    text = re.sub(r"^(\s*include )(.*)$", rf"\1{os.path.dirname(os.path.abspath(scene))}/\2", text, flags=re.M)
    copy = os.path.join(folder, os.path.basename(scene))
    with open(copy, "w") as file:
        file.write(text)
    return copy


def core_seconds(folder, used):
    """Of the steps [s]: the outermost phases of the file `timing` without the start, times ranks (one). Where others
    use the cores too, a clock shows more than the `used` seconds of a processor, which hold the start: the smaller.
    A run that stops has no such file."""
    timing = os.path.join(folder, "timing")
    if not os.path.exists(timing):
        return used
    with open(timing) as file:
        rows = re.findall(r"^(\S.*?) +\d+ +([\d.]+) +[\d.]+$", file.read(), re.M)
    return min(used, sum(float(seconds) for phase, seconds in rows if phase != "initialise"))


def complaint(text):
    """The first sentence of the program's message, without which step failed and where in the body: why a run stopped."""
    error = re.search(r"Error: (?:[^\n]*?the last one of [^:]*: )?(?:body .*?the point that rests at .*?: )?(.*)", text)
    return re.split(r"[:;] |\.(?: |$)", error[1])[0] if error else "no message"


def once(program, scene, settings):
    """A run whose seconds are its own, whatever runs beside it; ends the benchmark where a scene is refused."""
    with tempfile.TemporaryDirectory() as folder:
        words = [program, scene, "--output", folder]
        for setting in settings:
            words += ["--set", setting]
        with open(os.path.join(folder, "printed"), "w+") as printed:
            process = subprocess.Popen(words, env=scene_tools.environment(), stdout=printed, stderr=printed)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            printed.seek(0)
            text = printed.read()
        try:
            names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
            seconds = core_seconds(folder, usage.ru_utime + usage.ru_stime)
        except OSError:
            sys.exit(f"{' '.join(words)}\n{text}")
    return Run(dict(zip(names, zip(*rows))), seconds, complaint(text) if process.returncode else "")


def run(program, scene, case, integrator, newton, per_second, repeats):
    """The cheapest of some repetitions."""
    settings = list(case.settings) + INTEGRATORS[integrator].settings() + [
        f"{NEWTON_SECTION}/{setting}" for setting in NEWTON[newton]] + [
            f"Time/Step=1/{per_second}", f"Time/End={case.end}", "Time/Maximum cuts=0", "Output/Interval=0",
            "Output/Parts=statistics"]
    start, runs = time.time(), []
    while not runs or (len(runs) < repeats and time.time() - start < ENOUGH):
        runs.append(once(program, scene, settings))
    best = min(runs, key=lambda this: this.seconds)
    print(f"  {integrator}, Newton {newton}, 1/{per_second} s: until {best.until():g} s in {best.seconds:.2f} s "
          f"{best.complaint}", file=sys.stderr, flush=True)
    return best


def measure(program, case, integrators, newtons, steps, jobs, repeats):
    """{(integrator, Newton, steps per second): Run}, the longest runs first."""
    keys = [(integrator, newton, per_second) for per_second in sorted(steps, reverse=True)
            for integrator in integrators for newton in newtons]
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(jobs) as pool:
        scene = neutral_scene(os.path.join(ROOT, case.scene), folder)
        found = pool.map(lambda key: run(program, scene, case, *key, repeats), keys)
        return dict(zip(keys, found))


def finest(program, case, integrators, per_second, jobs):
    """The integrator of the reference and its runs, with the finest step and twice that; None if no run holds."""
    for integrator in (one for one in REFERENCES if one in integrators):
        steps = (per_second, per_second // 2)
        runs = measure(program, case, [integrator], [TO_THE_END], steps, jobs, 1)
        if not any(run.complaint for run in runs.values()):
            return integrator, list(runs.values())
    return None


def known_integrators(program):
    """Those of the table that the program has, by its own reference of keys."""
    section, key = INTEGRATOR_KEY.rsplit("/", 1)
    text = subprocess.run([program, "--reference"], capture_output=True, text=True).stdout
    row = re.search(rf"^## {section}\n(?:(?!## ).*\n)*?\| {key} \| [^|]*\| ((?:\\\||[^|])*)\|", text, re.M)
    if not row:
        sys.exit(f"time_integration.py: '{INTEGRATOR_KEY}' is no key of {program}; try another INTEGRATOR_KEY, as "
                 "'undine --reference' has it")
    allowed = {word.strip(" \\") for word in row[1].split("|")}
    return [name for name, integrator in INTEGRATORS.items() if integrator.kind in allowed]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--out", default=".")
    parser.add_argument("--case", action="append", choices=CASES)
    parser.add_argument("--integrator", action="append", choices=INTEGRATORS)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    report.need_matplotlib()
    os.makedirs(options.out, exist_ok=True)
    known = known_integrators(options.program)
    integrators = [name for name in known if name in (options.integrator or known)]
    newtons = [TO_THE_END] if options.quick else list(NEWTON)
    results = []
    for name in options.case or CASES:
        print(f"case {name}", file=sys.stderr)
        case = CASES[name]
        steps = case.steps[:QUICK_STEPS] if options.quick else case.steps
        reference = finest(options.program, case, known, steps[-1] * FINER, options.jobs)
        if not reference:
            print(f"time_integration.py: case {name} has no reference and is left out", file=sys.stderr)
            continue
        runs = measure(options.program, case, integrators, newtons, steps, options.jobs, options.repeats)
        results.append(report.Result(name, case, steps, runs, *reference))
        report.show(results[-1])
        report.write(results, options.out)  # after every case: a benchmark that is stopped keeps what it has


if __name__ == "__main__":
    main()
