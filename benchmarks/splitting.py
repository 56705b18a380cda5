#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies and fluid solved together or in turns: which steps hold, and what they cost.

usage: benchmarks/splitting.py [PROGRAM] [--out DIR] [--quick]

Writes splitting.md (tables) and splitting.png (energies over time) to DIR (default: .);
doc/splitting.md holds those of one machine. --quick leaves out the shortest steps and the search.
Needs the Debian package python3-matplotlib. One rank, one run at a time: about half an hour, with --quick some minutes.
"""
import argparse
import os
import re
import resource
import subprocess
import sys
import tempfile
import textwrap
from dataclasses import dataclass

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "checks"))
import scene_tools  # noqa: E402

SCENE = os.path.join(ROOT, "prm", "jet_two_sheets_split_2d.prm")
SCHEMES = {"simultaneous": ["Scheme=simultaneous"],
           "splitting u": ["Scheme=time_splitting", "Coupling/Fluid driven by=velocity"],
           "splitting w": ["Scheme=time_splitting", "Coupling/Fluid driven by=displacement"]}
STEPS = [30, 60, 120, 480]  # in a second
QUICK = STEPS[:3]
SHAKING = 10  # times the largest kinetic energy of the reference


def sheets(**keys):
    """Assignments to both sheets; the names of keys with _ for space."""
    return [f"Bodies/{sheet}/{key.replace('_', ' ')}={value}" for sheet in ("first", "second")
            for key, value in keys.items()]


def air_and_sheets(density, modulus, speed="4"):
    return sheets(Density=density, **{"Young's_modulus": modulus}) + [
        f"Fluid/Boundaries/jet/Velocity={speed}; 0"]


def stiff_sheets(density, modulus, damping, theta, newton, speed):
    """Few elements, right behind a grid line, as many corrections as given, converged or not."""
    return air_and_sheets(density, modulus, speed) + sheets(Cells="1, 6") + [
        f"Bodies/{sheet}/{corner} corner={x}, {y}" for sheet, at in (("first", 0.713), ("second", 1.213))
        for corner, x, y in (("Lower", at, -0.05), ("Upper", round(at + 0.02, 3), 0.6))] + [
            f"Probes/{sheet}_tip/Point={at}, 0.6" for sheet, at in (("first", 0.723), ("second", 1.223))
        ] + [f"Effects/damping/Stiffness coefficient={damping}", f"Time/Theta={theta}",
             f"Solid numerics/Newton iterations={newton}", "Effects/convection/Method=semi-Lagrangian"]


# Letter: (what, end, assignments)
CASES = {
    "A": ("stiff sheets, 100 kg/m³, 9.5e7 Pa, jet of 4 m/s from rest, theta 0.55", 2.5,
          stiff_sheets(100, 9.5e7, 2e-4, 0.55, 3, "4")),
    "B": ("stiff light sheets, 24.1 kg/m³, 7.7e7 Pa, jet up to 2 m/s within 0.3 s, theta 0.505", 8,
          stiff_sheets(24.1, 7.7e7, 1e-3, 0.505, 4, "2*min(t/0.3,1)")),
    "C": ("light sheets, 10 kg/m³, 3e6 Pa, jet of 4 m/s from rest, theta 0.75: the scene", 3, []),
    "D": ("rubber in water, 1100 kg/m³ against 1000, 1e8 Pa, jet of 1 m/s from rest, theta 0.75", 3,
          air_and_sheets(1100, 1e8, "1") + ["Fluid/Density=1000"]),
}
HEAVY = ("12000 kg/m³ against 1.2, 5e5 Pa, jet of 0.5 m/s, theta 0.75", 8,
         air_and_sheets(12000, 5e5, "0.5"))
SEARCH = [(density, modulus) for modulus in (3e5, 3e6) for density in (3, 10, 25, 100)]
THETAS = (0.6, 0.75)


@dataclass
class Run:
    """Columns of a run, seconds of a processor per simulated second, and why it stopped."""
    columns: dict
    seconds: float
    complaint: str

    def kinetic(self):
        return self.columns["solid kinetic energy"]

    def last_time(self):
        return self.columns["Time"][-1]

    def last_quarter(self):
        """Mean kinetic energy of the bodies in the last quarter of the steps."""
        rows = self.kinetic()[-max(1, len(self.kinetic()) // 4):]
        return sum(rows) / len(rows)

    def growth(self):
        """Factor of kinetic energy per step, from the mean of the first half to that of the second."""
        rows = self.kinetic()[1:]
        half = len(rows) // 2
        if half == 0:
            return float("nan")
        ratio = sum(rows[-half:]) / sum(rows[:half])
        return ratio ** (1 / half)


def complaint(text):
    """The program's message, shortened: why a step failed, without which one and where in the body."""
    error = re.search(r"Error: (.*?)(?=\n\S*The state|\Z)", text, re.S)[1]
    for preamble in (r".*?the last one of [^:]*: ", r".*?\.prm: at [\d.e+-]+ s ",
                     r"body .*?the point that rests at .*?: "):
        error = re.sub("^" + preamble, "", error, flags=re.S)
    return textwrap.shorten(re.split(r"[.:;] ", error)[0], 64, placeholder=" …")


def run(program, scheme, per_second, end, assignments):
    with tempfile.TemporaryDirectory() as folder:
        words = [SCENE, "--output", folder]
        for word in SCHEMES[scheme] + assignments + [
                f"Time/Step=1/{per_second}", f"Time/End={end}", "Time/Maximum cuts=0",
                "Output/Interval=0", "Output/Parts=statistics"]:
            words += ["--set", word]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        result = subprocess.run([program] + words, env=scene_tools.environment(),
                                capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        try:
            names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
        except OSError:
            sys.exit(result.stdout + result.stderr)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    columns = dict(zip(names, zip(*rows)))
    return Run(columns, used / max(columns["Time"][-1], 1e-9),
               complaint(result.stdout + result.stderr) if result.returncode else "")


def runs_of(program, end, assignments, schemes, steps):
    result = {}
    for scheme in schemes:
        for per_second in steps:
            result[scheme, per_second] = run(program, scheme, per_second, end, assignments)
            print(f"{scheme} 1/{per_second}: {result[scheme, per_second].last_time():.3f} s "
                  f"{result[scheme, per_second].complaint}", file=sys.stderr)
    return result


def verdict(this, reference):
    if this.complaint:
        return "stops"
    return "shakes" if this.last_quarter() > SHAKING * max(reference.kinetic()) else "holds"


def table(runs, reference):
    lines = ["| scheme | step [s] | verdict | until [s] | kinetic energy, largest [J] | in the last quarter [J] "
             "| factor per step | tip at the end [m] | s per simulated s | what the program says |",
             "|---" * 10 + "|"]
    for (scheme, per_second), this in runs.items():
        seconds = "" if this.complaint else f"{this.seconds:.2f}"
        lines.append(f"| {scheme} | 1/{per_second} | {verdict(this, reference)} | {this.last_time():.3f} "
                     f"| {max(this.kinetic()):.1e} | {this.last_quarter():.1e} | {this.growth():#.4g} "
                     f"| {this.columns['first_tip displacement x'][-1]:.4f} | {seconds} "
                     f"| {this.complaint} |")
    return lines


def cheapest(runs, reference):
    """What each scheme costs at the largest step that holds."""
    lines = ["", "| scheme | steps that hold [s] | s per simulated s at the largest |", "|---|---|---|"]
    for scheme in SCHEMES:
        held = [(per_second, this) for (name, per_second), this in runs.items()
                if name == scheme and verdict(this, reference) == "holds"]
        lines.append(f"| {scheme} | " + (", ".join(f"1/{per_second}" for per_second, _ in held) +
                                        f" | {held[0][1].seconds:.2f} |" if held else "none | |"))
    return lines


def plot(results, file):
    import matplotlib
    matplotlib.use("Agg")
    from PIL import Image
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(len(results), len(SCHEMES), figsize=(11, 2.6 * len(results)),
                                   sharey="row", sharex="row", squeeze=False)
    for row, (letter, runs) in zip(axes, results.items()):
        peak = max(runs["simultaneous", STEPS[0]].kinetic())
        row[0].set_ylim(1e-6 * peak, 1e7 * peak)
        row[0].set_ylabel(f"case {letter}\nenergy [J]")
        for axis, scheme in zip(row, SCHEMES):
            axis.set_title(scheme if letter == next(iter(results)) else "", fontsize=10)
            axis.set_yscale("log")
            for colour, (key, this) in enumerate((key, this) for key, this in runs.items()
                                                 if key[0] == scheme):
                times = this.columns["Time"][1:]
                axis.plot(times, this.kinetic()[1:], color=f"C{colour}", lw=1,
                          label=f"1/{key[1]} s")
                axis.plot(times, this.columns["solid elastic energy"][1:], color=f"C{colour}",
                          lw=0.7, ls=":")
                if this.complaint:
                    axis.plot(times[-1], min(this.kinetic()[-1], 0.5e7 * peak), "x",
                              color=f"C{colour}", ms=8, mew=2)
            axis.grid(alpha=0.3)
    axes[0][0].legend(fontsize=8, ncol=2)
    for axis in axes[-1]:
        axis.set_xlabel("time [s]")
    figure.suptitle("energies of the sheets: kinetic (full), elastic (dotted); x: the run stops", fontsize=10)
    figure.tight_layout()
    figure.savefig(file, dpi=75)
    Image.open(file).convert("RGB").quantize(64).save(file, optimize=True)


def differences(program):
    """Tips of heavy sheets by the three schemes at three steps; the reference is simultaneous."""
    title, end, assignments = HEAVY
    steps = QUICK
    runs = runs_of(program, end, assignments, SCHEMES, steps)
    lines = ["", f"## Heavy sheets: {title}, {end} s", "",
             "Largest difference between the tips' displacements at the times that all runs share, over the "
             "largest displacement of that tip.", "",
             "| tip | schemes | " + " | ".join(f"1/{step} s" for step in steps) + " | ratios |",
             "|---" * (3 + len(steps)) + "|"]
    names = list(SCHEMES)
    for tip in ("first", "second"):
        for one, other in ((0, 1), (0, 2), (1, 2)):
            values = []
            for step in steps:
                x, y = (runs[names[scheme], step].columns[f"{tip}_tip displacement x"][::step // steps[0]]
                        for scheme in (one, other))
                values.append(max(abs(a - b) for a, b in zip(x, y)) / max(map(abs, x)))
            lines.append(f"| {tip} | {names[one]}, {names[other]} | " +
                         " | ".join(f"{value:.2e}" for value in values) + " | " +
                         ", ".join(f"{a / b:.2f}" for a, b in zip(values, values[1:])) + " |")
    return lines


def search(program):
    """The scene with other densities and moduli; what stops, and when."""
    lines = ["", "## A search", "", "The scene with other sheets, 2.5 s: the verdict, and when a run stopped.", "",
             "| theta | density [kg/m³] | modulus [Pa] | simultaneous, 1/30 | " +
             " | ".join(f"{variant}, 1/{step}" for variant in "uw" for step in QUICK) + " |",
             "|---" * (4 + 2 * len(QUICK)) + "|"]
    for theta in THETAS:
        for density, modulus in SEARCH:
            assignments = air_and_sheets(density, modulus) + [f"Time/Theta={theta}"]
            runs = runs_of(program, 2.5, assignments, ["simultaneous"], STEPS[:1])
            reference = next(iter(runs.values()))
            if not reference.complaint:
                runs.update(runs_of(program, 2.5, assignments, list(SCHEMES)[1:], QUICK))
            words = [verdict(this, reference) + (f" {this.last_time():.2f} s" if this.complaint else "")
                     for this in runs.values()]
            words += [""] * (1 + 2 * len(QUICK) - len(words))
            lines.append(f"| {theta} | {density} | {modulus:g} | " + " | ".join(words) + " |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--out", default=".")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        sys.exit("splitting.py: this Debian package is needed: python3-matplotlib")
    os.makedirs(options.out, exist_ok=True)
    results, lines = {}, []
    for letter, (title, end, assignments) in CASES.items():
        print(f"case {letter}", file=sys.stderr)
        runs = runs_of(options.program, end, assignments, SCHEMES,
                       QUICK if options.quick else STEPS)
        reference = [this for (scheme, _), this in runs.items() if scheme == "simultaneous"][-1]
        lines += ["", f"## Case {letter}: {title}, {end} s", ""] + table(runs, reference)
        lines += cheapest(runs, reference)
        results[letter] = runs
    lines += differences(options.program)
    if not options.quick:
        lines += search(options.program)
    plot(results, os.path.join(options.out, "splitting.png"))
    with open(os.path.join(options.out, "splitting.md"), "w") as file:
        file.write("\n".join(lines[1:]) + "\n")


main()
