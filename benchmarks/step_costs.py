# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a step costs without those of the start, for scripts that compare ranks, programs or settings: seconds by phase, counts,
memory, messages; and tables of all numbers. Only Python's own library is needed.

The same scene is run twice, for the first steps alone and for some more; costs of a step are the differences, so that neither
the start nor the first steps count.
"""
import collections
import contextlib
import csv
import glob
import json
import os
import re
import shlex
import statistics
import sys
import tempfile
import textwrap

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, ROOT)
from study import columns, runs  # noqa: E402

FIRST = 2  # steps that do not count
COMPOSED = ("couple", "solid", "fluid")  # phases whose parts are told apart
NOT_OF_STEPS = ("initialise", "output", "report")
MONITORING = ["--mca", "pml_monitoring_enable", "2", "--mca", "pml_monitoring_enable_output", "3",
              "--mca", "pml_monitoring_filename"]  # 2: messages of collective operations apart; 3: a file for each rank
LEAST_SHARE = 0.005  # of a step, of a phase in a table
SECONDS, STEP = "s a step", "a step"


class Failure(Exception):
    """Why a run has no result, in one line."""


class Program:
    """How it is started; on one rank without `mpirun`, unless that is asked for."""

    def __init__(self, path, mpirun="mpirun", limit=0, always_by_mpirun=False):
        self.path, self.limit, self.always_by_mpirun = os.path.abspath(path), limit, always_by_mpirun
        self.mpirun = shlex.split(mpirun)
        if os.sep in self.mpirun[0]:
            self.mpirun[0] = os.path.abspath(self.mpirun[0])
        self.name = os.path.basename(path)

    def run(self, scene, settings, ranks, folder, options=()):
        """Results go to the folder."""
        words = [*self.mpirun, "-n", str(ranks), *options] if ranks > 1 or self.always_by_mpirun else []
        words += [self.path, scene, "--output", folder]
        words += runs.assignments({"Output/Interval": "0", "Output/Parts": "statistics", **settings})
        with tempfile.TemporaryFile("w+") as printed:
            try:
                result = runs.execute(words, self.limit, printed)
            except OSError as error:
                raise Failure(str(error)) from None
        if result["failure"]:
            raise Failure(reason(result))


def reason(result):
    """Why a run has failed, in a few words."""
    if "there is no such key here" in result["failure"]:
        return "does not know this key"
    return textwrap.shorten(runs.reason(result), 160, placeholder=" ...")


@contextlib.contextmanager
def run_once(program, scene, settings, ranks, steps, options=()):
    """The folder of the results of some steps, for as long as it is looked at."""
    with tempfile.TemporaryDirectory() as above:
        folder = os.path.join(above, "run")
        program.run(scene, {**settings, "Time/Maximum steps": str(steps)}, ranks, folder, options)
        yield folder


def costs_of(folder):
    """Calls and seconds by phase, the columns of `statistics` by name, and the summary."""
    with open(os.path.join(folder, "statistics")) as file:
        names, _, rows = columns.parse(file.read())
    with open(os.path.join(folder, "summary.json")) as file:
        summary = json.load(file)
    return columns.timing(os.path.join(folder, "timing")), {
        name: [row[k] for row in rows] for k, name in enumerate(names)}, summary


def difference(many, few, steps):
    """{phase: (calls, seconds)} of a step."""
    return {name: tuple(max(0, whole - start) / steps for whole, start in zip(both, few.get(name, (0, 0))))
            for name, both in many.items() if name.split(" / ")[0] not in NOT_OF_STEPS}


def measure(program, scene, settings, ranks, steps):
    """{(quantity, unit): value} of a scene, once."""
    with run_once(program, scene, settings, ranks, FIRST) as folder:
        few = costs_of(folder)[0]
    with run_once(program, scene, settings, ranks, FIRST + steps) as folder:
        many, table, summary = costs_of(folder)
    if table["Step"][-1] < FIRST + steps:
        raise Failure(f"is over after {table['Step'][-1]:.0f} of {FIRST + steps} steps")
    phases = difference(many, few, steps)
    result = {(name, SECONDS): seconds for name, (_, seconds) in phases.items()}
    result[STEP, SECONDS] = sum(seconds for name, (_, seconds) in phases.items() if " / " not in name)
    result["start", "s"] = sum(seconds for name, (_, seconds) in many.items() if name == "initialise")
    result["tangents", STEP] = sum(calls for name, (calls, _) in phases.items() if name.endswith("assemble tangent"))
    for quantity, column in (("corrections", "Newton iterations"), ("GMRES iterations", "Linear iterations")):
        if column in table:
            result[quantity, STEP] = sum(table[column][-steps:]) / steps
    if "Most iterations of a solve" in table:
        result["most iterations of a solve", "1"] = max(table["Most iterations of a solve"][-steps:])
    unknowns, memory = sum(summary["unknowns"].values()), summary["cost"]["peak memory [bytes]"]
    result["unknowns", "1"], result["peak memory", "bytes"] = unknowns, memory
    result["peak memory of an unknown", "bytes"] = memory / max(1, unknowns)
    return result


def median(results):
    """Of each quantity, of several measurements."""
    return {key: statistics.median(result.get(key, 0) for result in results) for key in results[0]}


def counted(folder):
    """Sums over all ranks of what the monitoring of Open MPI has written: messages and bytes between ranks as the program has
    asked for them, and within collective operations."""
    sums = collections.Counter()
    files = glob.glob(os.path.join(glob.escape(folder), "messages*.prof"))
    for name in files:
        with open(name) as file:
            for line in file:
                row = re.match(r"([EISR])\t\d+\t\d+\t(\d+) bytes\t(\d+) msgs", line)
                if row:
                    kind = "of collectives" if row[1] == "I" else "of pairs"
                    sums["bytes " + kind] += int(row[2])
                    sums["messages " + kind] += int(row[3])
    return sums if files else None


def messages(program, scene, settings, ranks, steps):
    """{(quantity, unit): value} of a step, from two runs that are monitored; nothing where MPI cannot do so."""
    found = []
    for number in (FIRST, FIRST + steps):
        with tempfile.TemporaryDirectory() as folder:
            with run_once(program, scene, settings, ranks, number, [*MONITORING, os.path.join(folder, "messages")]):
                found.append(counted(folder))
    if None in found:
        return {}
    kinds = ("messages of pairs", "messages of collectives", "bytes of pairs", "bytes of collectives")
    return {(kind, STEP): max(0, found[1][kind] - found[0][kind]) / steps for kind in kinds}


def parts(phases):
    """{part: seconds} that add up to a step: phases, those of others that consist of such, and what is left of these."""
    result = {}
    for name, seconds in phases.items():
        if " / " in name or name == STEP:
            continue
        inner = {other: value for other, value in phases.items()
                 if name in COMPOSED and re.fullmatch(re.escape(name) + r" / [^/]+", other)}
        result.update(inner)
        result[f"{name}: the rest" if inner else name] = max(0.0, seconds - sum(inner.values()))
    return result


def row(cells):
    return "| " + " | ".join(map(str, cells)) + " |"


def table(head, rows):
    """Lines of Markdown."""
    return [row(head), "|---" * len(head) + "|", *(row(cells) for cells in rows), ""]


def number(value, digits=3):
    """With some digits, without exponents for usual sizes."""
    if value is None:
        return ""
    return f"{value:.0f}" if abs(value) >= 10**digits else f"{value:.{digits}g}"


def indented(phase):
    levels = phase.split(" / ")
    return "&nbsp;&nbsp;" * (len(levels) - 1) + levels[-1]


class Listing:
    """A CSV file of all numbers, one a line, that is written as they come."""

    def __init__(self, path, names):
        self.file = open(path, "w", newline="")
        self.writer = csv.writer(self.file, lineterminator="\n")
        self.writer.writerow([*names, "quantity", "unit", "value"])

    def add(self, run, values):
        for (quantity, unit), value in values.items():
            self.writer.writerow([*run, quantity, unit, value if isinstance(value, str) else f"{value:.6g}"])
        self.file.flush()

    def close(self):
        self.file.close()


def read_listing(paths):
    """{run: {(quantity, unit): value}} of CSV files; the last one's numbers count."""
    found = {}
    for path in paths:
        with open(path, newline="") as file:
            for line in list(csv.reader(file))[1:]:
                *run, quantity, unit, value = line
                found.setdefault(tuple(run), {})[quantity, unit] = value if unit == "" else float(value)
    return found


def draw(plot, *arguments):
    """A plot of cost_plots.py, if it can be drawn here; says so if not."""
    try:
        import cost_plots
    except ImportError as error:
        say(f"no plot: {error}; '--plot FILE.csv' draws it where there is matplotlib")
        return
    getattr(cost_plots, plot)(*arguments)


def write_report(text, path):
    """To the file, and printed."""
    print(text)
    with open(path, "w") as file:
        file.write(text)


def say(text):
    print(text, file=sys.stderr, flush=True)
