# SPDX-License-Identifier: LGPL-2.1-or-later
"""All runs of a study: in parallel, resumable, within a limit of time."""
import contextlib
import fcntl
import os
import sys
import time
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait

from study import columns, description, quantities, runs
from study.cases import make_cases, ranks
from study.predictions import Predictions

LATER = {"failure": "left out: would not end within the time allowed", "left out": True}


def readable(seconds):
    if seconds < 90:
        return f"{seconds:.1f} s" if seconds < 9.95 else f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def of_file(program, file, folder, jobs, within=None):
    """The study of a file, and the results and folders of its cases, of which those are run that are not there."""
    study = description.read(program, file)
    campaign = Campaign(program, study, make_cases(study), folder, jobs, within)
    with only_one(folder):
        return study, campaign.carry_out(), campaign.folders


@contextlib.contextmanager
def only_one(folder):
    """Two calls at once must not write into the folder of a study or a map."""
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, ".lock"), "w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            sys.exit(f"Error: another study writes into '{folder}'. Wait for its end, or choose another --out.")
        yield


class Campaign:
    """Makes the runs of a study, or takes them from the folder of an earlier time. `within`: seconds, or None."""

    def __init__(self, program, study, cases, folder, jobs, within):
        self.program, self.study, self.cases = program, study, cases
        self.jobs = max(1, jobs // max(ranks(study, case) for case in cases))
        digest = runs.digest_of_file(program)
        self.parent = os.path.join(folder, "cases")
        self.folders = {case: os.path.join(self.parent, runs.identity(study, case, digest)) for case in cases}
        self.end = None if within is None else time.monotonic() + within
        self.predictions, self.results = Predictions(study), {}
        self.has_warned = False

    def say(self, text):
        print(text, file=sys.stderr, flush=True)

    def take_finished(self):
        """Results of an earlier time."""
        for case, folder in self.folders.items():
            result = runs.finished(folder, self.study.limit)
            if result:
                self.results[case] = result
                self.predictions.add(case, result)
        if self.results:
            self.say(f"{len(self.results)} of {len(self.cases)} runs are there already")
        elif os.path.isdir(self.parent) and any(entry.is_dir() for entry in os.scandir(self.parent)):
            self.say("the runs that are there were made by another program, or with another scene or settings")

    def fits(self, case):
        """Whether a case is expected to end in time."""
        if self.end is None:
            return True
        expected = self.predictions.wall_seconds(case)
        return time.monotonic() + (expected or 0) <= self.end

    def time_left(self, waiting):
        expected = [self.predictions.wall_seconds(case) for case in waiting]
        if not waiting or None in expected:
            return ""
        return f"; about {readable(max(sum(expected) / self.jobs, max(expected)))} left"

    def report(self, case, result, waiting):
        said = result["failure"] or f"{result['core seconds']:.3g} core s"
        self.say(f"[{len(self.results)}/{len(self.cases)}] {case.name(self.study)}: {said}{self.time_left(waiting)}")

    def warn_early(self, case):
        """A column that is misspelt is told after the first run, not after the last."""
        if self.results[case]["failure"] or self.has_warned:
            return
        self.has_warned = True
        for quantity in self.study.quantities:
            try:
                quantities.evaluate(quantity.in_case(case.settings(self.study)),
                                    columns.read(os.path.join(self.folders[case], "statistics")))
            except columns.NotEvaluated as reason:
                self.say(f"study: '{quantity.name}' cannot be evaluated from this run: {reason}")

    def make(self, case):
        """A run; one that was expected to fit into the time must not break that promise."""
        limit = self.study.limit
        if self.end is not None:
            remaining = max(1.0, self.end - time.monotonic())
            limit = min(limit, remaining) if limit else remaining
        result = runs.run(self.program, self.study, case, self.folders[case], limit)
        return dict(LATER) if result["stopped"] and limit != self.study.limit else result

    def carry_out(self):
        """{case: result} of all cases, coarse ones first; those that do not fit into the time are left out."""
        self.take_finished()
        same = {}  # cases that are the same run
        for case in self.cases:
            if case not in self.results:
                same.setdefault(self.folders[case], []).append(case)
        waiting = [cases[0] for cases in same.values()]
        with ThreadPoolExecutor(self.jobs) as pool:
            under_way = {}
            try:
                while waiting or under_way:
                    while waiting and len(under_way) < self.jobs:
                        case = waiting.pop(0)
                        if self.fits(case):
                            under_way[pool.submit(self.make, case)] = case
                        else:
                            self.results[case] = dict(LATER)
                            self.report(case, LATER, waiting)
                    done, _ = wait(under_way, return_when=FIRST_COMPLETED) if under_way else ((), ())
                    for future in done:
                        case = under_way.pop(future)
                        self.results[case] = future.result()
                        self.predictions.add(case, self.results[case])
                        self.report(case, self.results[case], waiting + list(under_way.values()))
                        self.warn_early(case)
            except KeyboardInterrupt:
                self.say("stopped; finished runs are kept, the same command goes on")
                os._exit(130)
        for case, *others in same.values():
            self.results.update({other: self.results[case] for other in others})
        return self.results
