#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run that SIGTERM or SIGINT stops says how to go on, and goes on as if nothing had happened; a second one ends it.

usage: check_signals.py PROGRAM SCENE.prm
"""
import dataclasses
import os
import pty
import re
import signal
import subprocess
import sys
import tempfile
import termios
import time

import scene_tools

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "campaign"))
import kill_faults  # noqa: E402

ROWS_BEFORE, STEPS_AFTER = 4, 3
LIMIT = 60  # wall seconds in which a run that is asked to stop must have ended
STOPPED, BY_MPIRUN = 7, 1  # exit codes; mpirun has its own after a signal to itself


@dataclasses.dataclass(frozen=True)
class Case:
    ranks: int
    fault: kill_faults.Signal

    def __str__(self):
        return f"{self.fault} on {self.ranks} rank(s)"


CASES = [Case(ranks, kill_faults.Signal(name, to))
         for name in (signal.SIGTERM, signal.SIGINT)
         for ranks, to in ((1, "ranks"), (2, "a rank"), (2, "launcher"))]


def n_rows(folder):
    path = os.path.join(folder, "statistics")
    return len(scene_tools.parse(scene_tools.statistics(folder))[2]) if os.path.exists(path) else 0


def wait_for_rows(process, folder):
    while n_rows(folder) < ROWS_BEFORE:
        if process.poll() is not None:
            sys.exit(f"the run has ended by itself, with exit code {process.returncode}")
        time.sleep(0.01)


def stop(case, program, scene, folder):
    """The last step of a run that is stopped."""
    command = scene_tools.command(program, [scene, "--output", folder], case.ranks)
    run = kill_faults.Run(command, program, folder + ".txt", scene_tools.environment())
    wait_for_rows(run.process, folder)
    case.fault.strike(run)
    code, printed = run.wait(LIMIT), run.printed()
    if code != (BY_MPIRUN if case.fault.to == "launcher" else STOPPED):
        sys.exit(f"{case}: exit code {code}\n{printed}")
    name = "SIGTERM" if case.fault.to == "launcher" else signal.Signals(case.fault.name).name
    for text in (f"stopped by {name}", f"'undine resume {folder}' continues it"):
        if text not in printed:
            sys.exit(f"{case}: '{text}' is not said, but\n{printed}")
    if run.outlive() or os.path.exists(os.path.join(folder, "lock")):
        sys.exit(f"{case}: processes or the lock are still there")
    return n_rows(folder) - 1


def go_on(program, ranks, folder, last_step):
    """Some steps more; returns the step at which the run goes on, and all of `statistics`."""
    printed = scene_tools.run(program, ["resume", folder, "--set",
                                        f"Time/Maximum steps={last_step + STEPS_AFTER}"],
                              ranks).stdout
    return int(re.search(r"^resumed at step (\d+)", printed, re.M)[1]), scene_tools.statistics(folder)


def end_by_second_signal(program, scene, folder):
    """The last step of a run that cannot stop, as its terminal does not take what it writes (as after Ctrl-S)."""
    controller, terminal = pty.openpty()
    process = subprocess.Popen([program, scene, "--output", folder, "--set",
                                "Output/checkpoint/Interval=1"], env=scene_tools.environment(),
                               stdout=terminal, stderr=subprocess.DEVNULL)
    wait_for_rows(process, folder)
    termios.tcflow(terminal, termios.TCOOFF)
    time.sleep(1)  # it writes a line every half second
    process.send_signal(signal.SIGTERM)
    time.sleep(kill_faults.BETWEEN_SIGNALS)
    if process.poll() is not None:
        sys.exit(f"exit code {process.returncode} after one signal to a run that cannot go on")
    process.send_signal(signal.SIGTERM)
    try:
        code = process.wait(LIMIT)
    except subprocess.TimeoutExpired:
        process.kill()
        sys.exit("a second SIGTERM does not end the process")
    os.close(controller)
    os.close(terminal)
    if code != -signal.SIGTERM:
        sys.exit(f"exit code {code} after a second SIGTERM")
    return n_rows(folder) - 1


def main():
    program, scene = os.path.abspath(sys.argv[1]), sys.argv[2]
    os.environ["OMPI_MCA_mpi_yield_when_idle"] = "1"  # ranks that wait leave a busy machine to others
    continued = {1: [], 2: []}  # texts of `statistics`, by ranks
    with tempfile.TemporaryDirectory() as folder:
        for number, case in enumerate(CASES):
            here = os.path.join(folder, f"case_{number}")
            last_step = stop(case, program, scene, here)
            begun, text = go_on(program, case.ranks, here, last_step)
            if begun != last_step:
                sys.exit(f"{case}: goes on from step {begun}, not from {last_step}")
            continued[case.ranks].append((last_step, text))
        here = os.path.join(folder, "twice")
        last_step = end_by_second_signal(program, scene, here)
        continued[1].append((last_step, go_on(program, 1, here, last_step)[1]))
        for ranks, texts in continued.items():
            here = os.path.join(folder, f"undisturbed_{ranks}")
            steps = max(last_step for last_step, _ in texts) + STEPS_AFTER
            scene_tools.run(program, [scene, "--output", here, "--set",
                                      f"Time/Maximum steps={steps}"], ranks)
            undisturbed = scene_tools.statistics(here)
            for last_step, text in texts:
                if not undisturbed.startswith(text) or not text.endswith("\n"):
                    sys.exit(f"stopped after step {last_step} on {ranks} rank(s): the steps after "
                             "it are not those of an undisturbed run")
    print(f"{len(CASES)} stopped and 1 ended by a second signal; all went on as undisturbed")


main()
