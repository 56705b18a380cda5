# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of a scene with settings of which each thing can be refined by a factor."""
import os
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

from study import quantities, runs
from study.columns import NotEvaluated, column, phases, read
from study.description import AXES, Quantity


LEAST_COST = 1e-3  # core seconds; less cannot be told


class Refused(Exception):
    """Why there is no run of that accuracy."""


@dataclass(frozen=True)
class Setting:
    """Factors of refinement of all knobs; what `runs` needs of a case."""
    knobs: tuple = field(compare=False)
    factors: tuple

    def settings(self, study):
        result = dict(study.settings)
        for knob, factor in zip(self.knobs, self.factors):
            result.update(knob.settings(factor))
        return result

    def name(self, _):
        return ", ".join(f"{key} {value}" for knob, factor in zip(self.knobs, self.factors)
                         for key, value in knob.settings(factor).items())

    def with_factor(self, k, factor):
        return Setting(self.knobs, self.factors[:k] + (factor,) + self.factors[k + 1:])


def quantity_of(name, measure, columns=()):
    """The quantity to be accurate: one column, or the vector of the columns that are its components."""
    components = [f"{name} {axis}" for axis in AXES if f"{name} {axis}" in columns] if name not in columns else []
    texts = dict.fromkeys(("unit", "period_of", "field", "body", "reference_file", "reference_column", "reference_times"), "")
    return Quantity(name=name, columns=components or [name], is_vector=True, factor=1.0, evaluate=measure, share_of_step=1.0,
                    start=0.0, until=0.0, periods=0, lower=[], upper=[], n_points=[], reference=[], reference_row={},
                    reference_factor=1.0, scale=0.0, **texts)


@dataclass
class Destination:
    """Where the runs go that have all outputs of the scene, one in the place of the other."""
    folder: str
    written: dict  # {"Section/Key": value} of outputs, which coarse runs do without
    overwrite: bool  # may they replace what the user has in the folder?


def seconds_of_outputs(result, folder):
    """Core seconds that a run in a folder has spent on outputs, which settings have little to do with: of the clock's, which
    the file `timing` has, the share that the run has had of a processor."""
    wall = result.get("wall seconds", 0.0)
    share = min(1.0, result["core seconds"] / wall) if wall > 0 else 1.0
    return share * phases(os.path.join(folder, "timing")).get("output", 0.0)


class Pilot:
    """Makes runs of a scene and remembers what they gave. Folders of coarse runs are in `folder`. `choose`: the quantity
    that is to be accurate, by the columns of the first run."""

    def __init__(self, program, study, choose, folder, deadline, destination=None, jobs=1):
        self.program, self.study, self.choose, self.quantity = program, study, choose, None
        self.folder, self.deadline, self.destination, self.jobs = folder, deadline, destination, jobs
        self.values, self.costs, self.failures = {}, {}, {}  # costs: core seconds without those of the start and of outputs
        self.paces = {}  # (seconds of the clock for the whole run, the same for each core second) of settings
        self.made = []  # (setting, core seconds, seconds of the clock) of runs made here, not taken from earlier studies
        self.too_coarse = {}  # {number of a knob: largest factor, below those of runs that succeed, with which one has failed}
        self.under_way = None  # the setting of a run with outputs
        self.has_outputs = False  # has there been one?

    def spent(self, setting):
        """(Core seconds without the start, seconds of the clock) of the last run made of a setting, and of all others, and
        their number."""
        last = max(k for k, (each, *_) in enumerate(self.made) if each == setting)
        others = [each for k, each in enumerate(self.made) if k != last]
        return self.made[last][1:], (sum(core for _, core, _ in others), sum(wall for *_, wall in others)), len(others)

    def seconds(self, setting, growth):
        """Of the clock, that a run will take that costs so many times as much as a setting: what its start and its outputs
        have taken does not grow."""
        whole, pace = self.paces[setting]
        return whole + (growth - 1) * self.costs[setting] * pace

    def limit(self):
        """Seconds that a run may take; 0: as many as it likes."""
        return max(1.0, self.deadline - time.monotonic()) if self.deadline else 0

    def run(self, setting):
        """Values of the quantity with a setting; None if the run has failed."""
        self.run_all([setting])
        return self.values.get(setting)

    def run_all(self, settings):
        """Make the runs of settings that are not there yet, as many at the same time as there are jobs."""
        missing = [setting for setting in dict.fromkeys(settings) if setting not in self.costs]
        folders = [os.path.join(self.folder, f"{len(self.made) + number}") for number in range(len(missing))]
        pool = ThreadPoolExecutor(self.jobs)
        try:
            results = list(pool.map(lambda *of_run: runs.once(self.program, self.study, *of_run, self.limit()), missing, folders))
        finally:
            pool.shutdown(wait=False, cancel_futures=True)  # a user who stops does not wait for runs
        for setting, folder, result in zip(missing, folders, results):
            self.made.append((setting, result["core seconds"], result["elapsed"]))
            self.take(setting, result, os.path.join(folder, "run"))

    def run_with_outputs(self, setting):
        """The same with all outputs that the scene asks for, in the user's folder; None if the run has failed."""
        folder = self.destination.folder
        words = [self.program, self.study.file, "--output", folder]
        words += ["--overwrite"] * (self.destination.overwrite or self.has_outputs)
        words += runs.assignments({**self.destination.written, **setting.settings(self.study)})
        self.has_outputs, self.under_way = True, setting
        with open(os.path.join(self.folder, "printed"), "w+") as printed:
            result = runs.execute(words, self.limit(), printed)
        self.under_way = None
        result.update(runs.summary_of(os.path.join(folder, "summary.json")))
        self.made.append((setting, result["core seconds"], result["elapsed"]))
        self.take(setting, result, folder)
        return self.values.get(setting)

    def take(self, setting, result, folder):
        """Note what a run in a folder has given."""
        if result["stopped"]:
            raise Refused("the time allowed is over")
        self.costs[setting] = max(result["core seconds"] - seconds_of_outputs(result, folder), LEAST_COST)
        wall = result.get("wall seconds", result["core seconds"])
        self.paces[setting] = result.get("elapsed", wall) / result.get("repetitions", 1), wall / max(result["core seconds"], LEAST_COST)
        said = result["failure"]
        print(f"  {setting.name(self.study)}: {said or format(result['core seconds'], '.3g') + ' core s'}", file=sys.stderr,
              flush=True)
        if said:
            self.failures[setting] = said
            self.values.pop(setting, None)
            return
        try:
            columns = read(os.path.join(folder, "statistics"))
            self.quantity = self.quantity or self.choose(columns)
            for name in self.quantity.columns:
                column(columns, name)
        except NotEvaluated as reason:  # no setting changes that
            raise Refused(str(reason)) from reason
        try:
            self.values[setting] = quantities.evaluate(self.quantity, columns)
        except NotEvaluated as reason:  # such as no whole period, of which a finer run may have one
            self.failures[setting] = str(reason)
            print(f"  {reason}", file=sys.stderr, flush=True)

    def forget(self, setting):
        """That a run has been taken which does not have the quantity."""
        self.costs.pop(setting, None)
        if not self.values:
            self.quantity = None

    def times(self, settings):
        """Those of the run with the longest steps, as long as all of them last: runs that end when they are steady do not
        end together."""
        all_times = [self.values[each].times for each in settings]
        if self.quantity.evaluate != "over time":
            return min(all_times, key=len)
        begin, end = max(times[0] for times in all_times), min(times[-1] for times in all_times)
        slack, times = 1e-9 * abs(end), min(all_times, key=len)
        return times[(times >= begin - slack) & (times <= end + slack)]

    def compare(self, settings, times):
        """Values of several settings at common times, [setting][time][component]."""
        found = [self.values[setting] for setting in settings]
        return [each.at(times) if self.quantity.evaluate == "over time" else each.values for each in found]
