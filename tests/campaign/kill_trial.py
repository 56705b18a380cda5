# SPDX-License-Identifier: LGPL-2.1-or-later
"""One run that is hit, goes on, and must end as if nothing had happened."""
import dataclasses
import glob
import os
import re
import shlex
import signal
import sys
import time

import kill_checks as checks
import kill_faults as faults
import kill_scenes
from kill_checks import Wrong, scene_tools

STOPPED, FULL, BY_LAUNCHER = 7, 4, 1  # exit codes; mpirun has its own after a signal to itself


@dataclasses.dataclass(frozen=True)
class Moment:
    """What is done to one run, and on how many ranks it begins and goes on."""
    number: int
    scene: kill_scenes.Scene
    ranks: tuple  # of the launches one after the other
    interval: int  # steps between checkpoints
    hits: tuple  # pairs of a fault and when it strikes (None: by itself), one for each launch but the last

    def __str__(self):
        hits = "; ".join(f"{fault}, {'by itself' if when is None else when}" for fault, when in self.hits)
        return (f"{self.number}: {self.scene.name}, ranks {self.ranks}, checkpoint every "
                f"{self.interval} step(s), {hits}")


@dataclasses.dataclass
class Outcome:
    """Of one hit."""
    fault: object
    end: str = "hung"
    steps_lost: int = 0
    lock_left: bool = False
    torn: bool = False  # a temporary file was left


class Launcher:
    """How the program is started."""

    def __init__(self, program, template):
        """`template`: what starts it on {ranks} ranks; without one mpirun, from two ranks on."""
        self.program = os.path.abspath(program)
        self.template = template

    def command(self, ranks, arguments):
        if self.template:
            return shlex.split(self.template.format(ranks=ranks)) + [self.program] + arguments
        return scene_tools.command(self.program, arguments, ranks)

    def start(self, command, output):
        # Ranks that wait give their processor to the other moments.
        environment = dict(scene_tools.environment(), OMPI_MCA_mpi_yield_when_idle="1")
        return faults.Run(command, self.program, output, environment)


@dataclasses.dataclass(frozen=True)
class Reference:
    """An uninterrupted run."""
    folder: str
    seconds: float  # wall time of all of it
    start: float  # and of that before the first row of `statistics`
    last_step: int
    bytes: int  # on the disk


def run_reference(launcher, scene, ranks, folder):
    """Exits if the scene cannot be run."""
    start, first_row = time.monotonic(), 0
    run = launcher.start(launcher.command(ranks, scene.arguments() + ["--output", folder]),
                         folder + ".txt")
    while run.process.poll() is None:
        if not first_row and os.path.exists(os.path.join(folder, "statistics")):
            first_row = time.monotonic() - start
        time.sleep(0.01)
    if run.process.returncode != 0:
        sys.exit(f"{scene.name} on {ranks} rank(s) does not even run undisturbed:\n{run.printed()}")
    return Reference(folder, time.monotonic() - start, first_row, checks.last_step(folder),
                     faults.used(folder))


class Trial:
    """Carries out a moment in a folder that it makes."""

    def __init__(self, moment, launcher, references, disks, folder, limit):
        """`references`: by name of the scene and ranks; `limit`: seconds after which a run counts as hung."""
        self.moment, self.launcher, self.references = moment, launcher, references
        self.disks, self.folder, self.limit = disks, os.path.join(folder, "run"), limit
        self.last_step = 0  # of the rows of `statistics`
        self.kept_step = 0  # which must not be lost
        self.is_resuming = False
        self.outcomes = []

    def carry_out(self):
        """What was wrong, or None."""
        os.makedirs(self.folder)
        checks.add_foreign_files(self.folder)
        try:
            for launch in range(len(self.moment.hits)):
                self.hit(launch)
            self.finish()
        except Wrong as wrong:
            return str(wrong)
        return None

    def hit(self, launch):
        """Launch, strike, and look at what is left."""
        fault, when = self.moment.hits[launch]
        run = self.start(launch, fault)
        struck = when is None or when.wait(run, self.folder)
        refused = struck and when is not None and not fault.strike(run)
        code = run.wait(self.limit)
        outlived = run.outlive()
        if isinstance(fault, faults.FullDisk):
            self.disks.keep(self.folder)
        begun = self.check_begin(run.printed())
        self.last_step = checks.check_stopped(self.folder)
        self.outcomes.append(Outcome(fault, lock_left=os.path.exists(self.folder + "/lock"),
                                     torn=self.has_temporary_files()))
        if refused or outlived or code == faults.HUNG:
            raise Wrong(f"{fault}: the program does not end")
        if code != 0 and not struck:
            raise Wrong(f"exit code {code} before anything was done to it")
        self.judge(fault, code, run.printed(), begun)

    def start(self, launch, fault=None):
        """Start the run, or go on with it."""
        ranks = self.moment.ranks[launch]
        command = self.launcher.command(ranks, self.arguments())
        if isinstance(fault, faults.FullDisk):
            reference = self.references[self.moment.scene.name, min(ranks, 2)]
            missing = max(0, reference.bytes - faults.used(self.folder))
            command = self.disks.command(command, self.folder, int(fault.share * missing))
        return self.launcher.start(command, f"{self.folder}.{launch}.txt")

    def arguments(self):
        self.is_resuming = bool(glob.glob(self.folder + "/checkpoint/slot_[01].h5"))
        if self.is_resuming:
            return ["resume", self.folder]
        if self.kept_step > 0:
            raise Wrong("there is no checkpoint")
        return self.moment.scene.arguments() + [
            "--output", self.folder, "--set",
            f"Output/checkpoint/Interval={self.moment.interval}"]

    def has_temporary_files(self):
        return bool(glob.glob(self.folder + "/**/*.part", recursive=True))

    def check_begin(self, printed):
        """The step at which a launch began, None if it did not come that far; notes what the hit before it has cost."""
        resumed = re.search(r"^resumed at step (\d+)", printed, re.M)
        # Until a run has begun anew, rows that it finds are those of an earlier launch.
        begins_anew = not self.is_resuming and re.search(r"^ +step +time", printed, re.M)
        if not resumed and not begins_anew:
            return None
        step = int(resumed[1]) if resumed else 0
        if not self.kept_step <= step <= self.last_step:
            raise Wrong(f"goes on from step {step}; statistics had reached {self.last_step}, "
                        f"{self.kept_step} must be kept")
        if self.outcomes:
            self.outcomes[-1].steps_lost = self.last_step - step
        return step

    def judge(self, fault, code, printed, begun):
        """Did the run end as it must? Sets which step must not be lost."""
        outcome = self.outcomes[-1]
        stepped = begun is not None and self.last_step > begun
        self.kept_step = max(self.kept_step, begun or 0, self.last_step - self.moment.interval)
        if code == 0 or self.has_ended():
            outcome.end = "ended before"
            self.kept_step = self.last_step
        elif isinstance(fault, faults.FullDisk):
            outcome.end = "stopped"
            if code != FULL or "Error:" not in printed:
                raise Wrong(f"exit code {code} instead of {FULL} on a full disk, or no message")
        elif not fault.lets_it_stop:
            outcome.end = "killed" if stepped else "killed at start"
        elif code == (BY_LAUNCHER if fault.to == "launcher" else STOPPED) and "undine resume" in printed:
            outcome.end = "stopped"
            self.kept_step = self.last_step
        elif not stepped and code in (BY_LAUNCHER, 128 + fault.name):
            outcome.end = "killed at start"
        else:
            raise Wrong(f"exit code {code} after {fault}, or it is not said how to go on")
        if outcome.end == "stopped" and outcome.lock_left:
            raise Wrong("the run has stopped in order, but its lock is still there")

    def has_ended(self):
        """Does the folder say so?"""
        try:
            with open(self.folder + "/record.txt") as file:
                return "run has ended\n" in file
        except OSError:
            return False

    def finish(self):
        """The last launch, which nothing disturbs."""
        run = self.start(len(self.moment.hits))
        code = run.wait(self.limit)
        if code != 0:
            raise Wrong(f"exit code {code} when going on: {run.printed()[-500:]}")
        self.check_begin(run.printed())
        same_ranks = len(set(self.moment.ranks)) == 1
        reference = self.references[self.moment.scene.name, self.moment.ranks[0] if same_ranks else 1]
        checks.check_finished(self.folder, reference.folder, same_ranks)
