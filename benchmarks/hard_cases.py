#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The hard cases of prm/hard/: verdicts of all schemes, what must be seen, and whether steps of 1/30 and 1/240 s dampen more
than sixteen times shorter ones do.

usage: benchmarks/hard_cases.py [PROGRAM] [--case NAME]... [--scheme NAME...] [--step STEP...] [--shorter STEP...]
                                [--check | --short] [--limit SECONDS] [--out DIR] [--jobs N]

Makes the runs, or takes those that are there, and writes hard_cases.md (table) to DIR (default: output/hard_cases); an error if
something that must be seen or the comparison with shorter steps is not as it must be, which the table marks with (!).
Scenes of particles have that scheme alone, of which steps are frames, and a table of their own. --check: only the scheme that
must be stable, and an error if it is not or does not show what must be seen. --short: the same for the first few steps only, as
the tests do.
"""
import argparse
import math
import os
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, ROOT)
import hard_case_laws as laws  # noqa: E402
from study import campaign, cases, columns, description, tables  # noqa: E402

SPLITTING = {"Scheme": "time_splitting", "Time/Integrator": "theta"}  # with that of two stages u and w are the same
SCHEMES = {"simultaneous": {"Scheme": "simultaneous"}, "splitting u": SPLITTING,
           "splitting w": {**SPLITTING, "Coupling/Fluid driven by": "displacement"}}
PARTICLE = {"particle": {}}
STEPS = ("1/30", "1/240")
SHORTER = {"1/30": "1/480", "1/240": "1/3840"}  # sixteen times
RESOLVED = 0.5  # largest omega h of a swing of which the damping is judged


def scene_file(name):
    return os.path.join(ROOT, "prm", "hard", f"{name}.prm")


def seconds(step):
    return 1 / float(step[2:])


def schemes(name):
    """{scheme: its settings} of a scene."""
    return PARTICLE if laws.SCENES[name].scheme in PARTICLE else SCHEMES


class Runs:
    """Those of one scene, by scheme and step."""

    def __init__(self, options, name, end=None):
        steps = [*STEPS, *SHORTER.values()]
        self.schemes, self.hard = schemes(name), laws.SCENES[name]
        variations = [description.Variation("scheme", "variant", list(self.schemes), list(self.schemes.values()), []),
                      description.Variation("step", "variant", steps, [{"Time/Step": step} for step in steps], [])]
        settings = {} if end is None else {"Time/End": f"{end:.10g}"}
        self.study = description.Study(name, "", scene_file(name), 1, 0, options.limit, "core seconds", "all", [], settings, variations)
        self.options, self.folder = options, os.path.join(options.out, name)
        self.made = {}

    def make(self, wanted):
        """Make or take the runs of a list of pairs of scheme and step."""
        positions = {pair: cases.Case((list(self.schemes).index(pair[0]), self.study.variations[1].names.index(pair[1])))
                     for pair in wanted}
        made = campaign.Campaign(self.options.program, self.study, list(positions.values()), self.folder, self.options.jobs, None)
        with campaign.only_one(made.parent):
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

    def seen(self, law, step):
        """The number of a law in the run that must be stable; not a number if there is none."""
        run = self.made.get((self.hard.scheme, step), {"columns": {}})["columns"]
        return law.value(run) if len(run.get("Time", ())) > 1 else math.nan

    def is_stable(self, step):
        result = self.made[self.hard.scheme, step]["result"]
        return not result["failure"] and result.get("verdict") == "stable"


def agreement(hard, run, reference, step):
    """What is damped more or less than in shorter steps, in words, and whether that is within max(20 %, 0.002) of the damping
    ratio where the reference swings so slowly that these steps resolve it, else within 5 % of the mean deflection."""
    if not math.isnan(hard.swings):
        omega, wanted = laws.swing(reference, hard.column, hard.swings)
        if omega * seconds(step) <= RESOLVED:
            omega, value = laws.swing(run, hard.column, hard.swings)
            return (f"omega h = {omega * seconds(step):.2f}, damping ratio {value:.4f} against {wanted:.4f}",
                    abs(value - wanted) <= max(0.2 * abs(wanted), 0.002))
    begin = hard.swings if math.isnan(hard.mean) else hard.mean
    value, wanted = (laws.mean(columns_of, hard.column, begin) for columns_of in (run, reference))
    return f"mean {value:.4g} against {wanted:.4g} m", abs(value - wanted) <= 0.05 * abs(wanted)


def rows(made, name):
    """Of the table."""
    hard = laws.SCENES[name]
    result = []
    for step in made.options.step:
        values = [(law, made.seen(law, step)) for law in hard.laws()] if (hard.scheme, step) in made.made else []
        shown = "; ".join(f"{value:.4g}" + ("" if law.keeps(value) else " (!)") for law, value in values)
        compared = ""
        reference = made.made.get(("simultaneous", SHORTER[step]))
        if hard.column and reference and ("simultaneous", step) in made.made and made.is_stable(step) and not reference["result"]["failure"]:
            compared, close = agreement(hard, made.made["simultaneous", step]["columns"], reference["columns"], step)
            compared += "" if close else " (!)"
        wanted = "; ".join(f"{law.what}: {law.wanted:.4g}" for law in hard.laws())
        result.append([name, step, *(made.verdict(scheme, step) for scheme in made.schemes), wanted, shown, compared])
    return result


def head(of_schemes):
    return ["scene", "step [s]", *of_schemes, "must be seen", "seen", "against steps of h/16"]


def full(options):
    """The tables of all schemes."""
    written = []
    for of_schemes in (SCHEMES, PARTICLE):
        lines = []
        for name in (each for each in options.case if schemes(each) is of_schemes):
            wanted = [(scheme, step) for scheme in of_schemes if scheme in options.scheme for step in options.step]
            wanted += [("simultaneous", SHORTER[step]) for step in options.step if step in options.shorter and laws.SCENES[name].column]
            made = Runs(options, name).make(wanted)
            lines += rows(made, name)
            print("\n".join(tables.table(head(of_schemes), lines[-len(options.step):])[2:-1]), flush=True)
        if lines:
            written += [*tables.table(head(of_schemes), lines), ""]
    with open(os.path.join(options.out, "hard_cases.md"), "w") as file:
        file.write("\n".join(written))
    if wrong := [line for line in written if "(!)" in line]:
        sys.exit("\n".join(["not as it must be:", *wrong]))


def faults(options, name, step):
    """What is not as it must be in a run of the scheme that must be stable; in a short one laws are judged that hold from the
    start."""
    hard = laws.SCENES[name]
    end = hard.short * (1 if step == STEPS[0] else 0.25) if options.short else None
    made = Runs(options, name, end).make([(hard.scheme, step)])
    print(f"{name}, {step} s: {made.verdict(hard.scheme, step)}", flush=True)
    if not made.is_stable(step):
        return [f"{name}, {step} s: {made.made[hard.scheme, step]['result']}"]
    wrong = []
    for law in (each for each in hard.laws() if each.early or not options.short):
        value = made.seen(law, step)
        print(f"  {law.what}: {value:.6g}, must be {law.wanted:.6g} +- {law.allowed:.3g}", flush=True)
        if not law.keeps(value):
            wrong.append(f"{name}, {step} s: {law.what} is {value:.6g}")
    return wrong


def check(options):
    """The scheme that must be stable alone; exits with what is not as it must be."""
    with tempfile.TemporaryDirectory() as folder:
        options.out = folder
        wrong = [fault for name in options.case for step in STEPS for fault in faults(options, name, step)]
    if wrong:
        sys.exit("\n".join(wrong))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--case", action="append", choices=list(laws.SCENES), metavar="NAME")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--shorter", nargs="*", default=list(STEPS), help="steps that are compared with h/16 (default: all)")
    parser.add_argument("--scheme", nargs="*", choices=[*SCHEMES, *PARTICLE], default=[*SCHEMES, *PARTICLE])
    parser.add_argument("--step", nargs="*", choices=STEPS, default=list(STEPS))
    parser.add_argument("--limit", type=float, default=3600, help="of a run [s] (default: 3600)")
    parser.add_argument("--out", default=os.path.join("output", "hard_cases"))
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    options.case = options.case or list(laws.SCENES)
    os.makedirs(options.out, exist_ok=True)
    if options.check or options.short:
        check(options)
    else:
        full(options)


if __name__ == "__main__":
    main()
