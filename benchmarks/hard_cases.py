#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The hard cases of prm/hard/: verdicts of all schemes, what must be seen, and whether steps of 1/30 and 1/240 s dampen more
than sixteen times shorter ones do.

usage: benchmarks/hard_cases.py [PROGRAM] [--case NAME]... [--scheme NAME...] [--step STEP...] [--shorter STEP...]
                                [--check | --short | --pictures] [--limit SECONDS] [--out DIR] [--jobs N]

Makes the runs, or takes those that are there, and writes hard_cases.md (table) to DIR (default: output/hard_cases).
--check: only the simultaneous scheme, and an error if it is not stable or does not show what must be seen. --short: the same
for the first few steps only, as the tests do. --pictures: only a picture of each scene, all of them in hard_cases.png.
"""
import argparse
import math
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, ROOT)
import hard_case_laws as laws  # noqa: E402
from study import campaign, cases, columns, description, runs, tables  # noqa: E402

SPLITTING = {"Scheme": "time_splitting", "Time/Integrator": "theta"}  # with that of two stages u and w are the same
SCHEMES = {"simultaneous": {"Scheme": "simultaneous"}, "splitting u": SPLITTING,
           "splitting w": {**SPLITTING, "Coupling/Fluid driven by": "displacement"}}
STEPS = ("1/30", "1/240")
SHORTER = {"1/30": "1/480", "1/240": "1/3840"}  # sixteen times
RESOLVED = 0.5  # largest omega h of a swing of which the damping is judged


def scene_file(name):
    return os.path.join(ROOT, "prm", "hard", f"{name}.prm")


def seconds(step):
    return 1 / float(step[2:])


class Runs:
    """Those of one scene, by scheme and step."""

    def __init__(self, options, name, end=None):
        steps = [*STEPS, *SHORTER.values()]
        variations = [description.Variation("scheme", "variant", list(SCHEMES), list(SCHEMES.values()), []),
                      description.Variation("step", "variant", steps, [{"Time/Step": step} for step in steps], [])]
        settings = {} if end is None else {"Time/End": f"{end:.10g}"}
        self.study = description.Study(name, "", scene_file(name), 1, 0, options.limit, "core seconds", "all", [], settings, variations)
        self.options, self.folder = options, os.path.join(options.out, name)
        self.made = {}

    def make(self, wanted):
        """Make or take the runs of a list of pairs of scheme and step."""
        positions = {pair: cases.Case((list(SCHEMES).index(pair[0]), self.study.variations[1].names.index(pair[1])))
                     for pair in wanted}
        made = campaign.Campaign(self.options.program, self.study, list(positions.values()), self.folder, self.options.jobs, None)
        results = made.carry_out()
        for pair, case in positions.items():
            path = os.path.join(made.folders[case], "statistics")
            self.made[pair] = {"result": results[case], "columns": columns.read(path) if os.path.exists(path) else {}}
        return self

    def verdict(self, scheme, step):
        """In a word, with what else matters."""
        if (scheme, step) not in self.made:
            return ""
        result = self.made[scheme, step]["result"]
        if result["stopped"] or "verdict" not in result:
            return result["failure"] or "no verdict"
        redone = f", {result['steps redone']} of {result['steps']} steps redone" if result["steps redone"] else ""
        at = f" at {result['reached']:.3g} s" if result["verdict"] == "failed" else ""
        return result["verdict"] + at + redone

    def seen(self, step):
        """The number of the law in the simultaneous run; not a number if there is none."""
        run, law = self.made.get(("simultaneous", step), {"columns": {}})["columns"], laws.SCENES[self.study.title].law
        return law.value(run) if len(run.get("Time", ())) > 1 else math.nan

    def is_stable(self, step):
        result = self.made["simultaneous", step]["result"]
        return not result["failure"] and result.get("verdict") == "stable"


def motion(hard, run, step):
    """How it is judged, and by what: omega h and damping ratio of a swing that steps resolve, else the mean deflection."""
    if not math.isnan(hard.swings):
        omega, ratio = laws.swing(run, hard.column, hard.swings)
        if omega * seconds(step) <= RESOLVED:
            return "damping", omega, ratio
    begin = hard.swings if math.isnan(hard.mean) else hard.mean
    return "mean", math.nan, laws.mean(run, hard.column, begin)


def agreement(hard, run, reference, step):
    """What is damped more or less than in shorter steps, in words, and whether that is within max(20 %, 0.002) of the damping
    ratio, or within 5 % of the mean deflection."""
    how, omega, value = motion(hard, run, step)
    if how == "damping":
        wanted = laws.swing(reference, hard.column, hard.swings)[1]
        return (f"omega h = {omega * seconds(step):.2f}, damping ratio {value:.4f} against {wanted:.4f}",
                abs(value - wanted) <= max(0.2 * abs(wanted), 0.002))
    wanted = laws.mean(reference, hard.column, hard.swings if math.isnan(hard.mean) else hard.mean)
    return f"mean {value:.4g} against {wanted:.4g} m", abs(value - wanted) <= 0.05 * abs(wanted)


def rows(made, name):
    """Of the table."""
    hard = laws.SCENES[name]
    result = []
    for step in made.options.step:
        value = made.seen(step)
        shown = "" if math.isnan(value) else f"{value:.4g}" + ("" if hard.law.keeps(value) else " (!)")
        compared = ""
        reference = made.made.get(("simultaneous", SHORTER[step]))
        if hard.column and reference and made.is_stable(step) and not reference["result"]["failure"]:
            compared, close = agreement(hard, made.made["simultaneous", step]["columns"], reference["columns"], step)
            compared += "" if close else " (!)"
        result.append([name, step, *(made.verdict(scheme, step) for scheme in SCHEMES),
                       f"{hard.law.what}: {hard.law.wanted:.4g}", shown, compared])
    return result


HEAD = ["scene", "step [s]", *SCHEMES, "must be seen", "seen", "against steps of h/16"]


def full(options):
    """The table of all schemes."""
    lines = []
    for name in options.case:
        wanted = [(scheme, step) for scheme in options.scheme for step in options.step]
        wanted += [("simultaneous", SHORTER[step]) for step in options.step if step in options.shorter and laws.SCENES[name].column]
        made = Runs(options, name).make(wanted)
        lines += rows(made, name)
        print("\n".join(tables.table(HEAD, lines[-len(options.step):])[2:-1]), flush=True)
    with open(os.path.join(options.out, "hard_cases.md"), "w") as file:
        file.write("\n".join(tables.table(HEAD, lines)))


def faults(options, name, step):
    """What is not as it must be in a run of the simultaneous scheme; in a short one a law is judged that holds from the start."""
    hard = laws.SCENES[name]
    end = hard.short * (1 if step == STEPS[0] else 0.25) if options.short else None
    made = Runs(options, name, end).make([("simultaneous", step)])
    print(f"{name}, {step} s: {made.verdict('simultaneous', step)}", flush=True)
    if not made.is_stable(step):
        return [f"{name}, {step} s: {made.made['simultaneous', step]['result']}"]
    if options.short and not hard.law.early:
        return []
    value = made.seen(step)
    print(f"  {hard.law.what}: {value:.6g}, must be {hard.law.wanted:.6g} +- {hard.law.allowed:.3g}", flush=True)
    return [] if hard.law.keeps(value) else [f"{name}, {step} s: {hard.law.what} is {value:.6g}"]


def check(options):
    """The simultaneous scheme alone; exits with what is not as it must be."""
    with tempfile.TemporaryDirectory() as folder:
        options.out = folder
        wrong = [fault for name in options.case for step in STEPS for fault in faults(options, name, step)]
    if wrong:
        sys.exit("\n".join(wrong))


def picture(options, name):
    """The file of a picture of a run with steps of 1/30 s, which is made if it is not there; None if that fails."""
    folder = os.path.join(options.out, "pictures", name)
    file = os.path.join(folder, "frame_0000.png")
    if not os.path.exists(file):
        subprocess.run([options.program, scene_file(name), "--output", folder, "--overwrite", "--set", "Output/Parts=vtu"],
                       env=runs.environment(), stdout=subprocess.DEVNULL, check=False)
        with open(os.path.join(folder, "solution.pvd")) as written:
            times = sorted(set(map(float, re.findall(r'timestep="([^"]+)"', written.read()))))
        frame = round(laws.SCENES[name].shown * (len(times) - 1))
        subprocess.run([os.path.join(ROOT, "contrib", "render"), folder, "--out", folder, "--frames", f"{frame}:{frame + 1}"],
                       check=False)
        made = sorted(each for each in os.listdir(folder) if each.startswith("frame_"))
        if made:
            os.replace(os.path.join(folder, made[0]), file)
    return file if os.path.exists(file) else None


def pictures(options):
    """All scenes on a sheet."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    across = 6
    figure, axes = pyplot.subplots(math.ceil(len(options.case) / across), across, squeeze=False,
                                   figsize=(2.2 * across, 1.45 * math.ceil(len(options.case) / across)))
    for axis in axes.flat:
        axis.axis("off")
    for axis, name in zip(axes.flat, options.case):
        file = picture(options, name)
        if file:
            axis.imshow(pyplot.imread(file))
        axis.set_title(name, fontsize=6)
    figure.tight_layout(pad=0.3)
    figure.savefig(os.path.join(options.out, "hard_cases.png"), dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--case", action="append", choices=list(laws.SCENES), metavar="NAME")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--pictures", action="store_true")
    parser.add_argument("--shorter", nargs="*", default=list(STEPS), help="steps that are compared with h/16 (default: all)")
    parser.add_argument("--scheme", nargs="*", choices=list(SCHEMES), default=list(SCHEMES))
    parser.add_argument("--step", nargs="*", choices=STEPS, default=list(STEPS))
    parser.add_argument("--limit", type=float, default=3600, help="of a run [s] (default: 3600)")
    parser.add_argument("--out", default=os.path.join("output", "hard_cases"))
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    options.case = options.case or list(laws.SCENES)
    os.makedirs(options.out, exist_ok=True)
    if options.pictures:
        pictures(options)
    elif options.check or options.short:
        check(options)
    else:
        full(options)


if __name__ == "__main__":
    main()
