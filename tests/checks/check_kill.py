#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run killed at a random moment loses at most one checkpoint interval, and its files are valid.

usage: check_kill.py PROGRAM SCENE.prm [KILLS]
"""
import glob
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import xml.dom.minidom

import scene_tools

INTERVAL = 3  # steps between checkpoints
MOST_STEPS = 12  # before a kill
MORE = 0.3  # at most so many wall seconds after them
PATIENCE = 120  # wall seconds after which a run counts as hung


def n_steps(folder):
    """The last step that `statistics` holds; -1 without rows."""
    path = os.path.join(folder, "statistics")
    return len(scene_tools.parse(scene_tools.statistics(folder))[2]) - 1 if os.path.exists(path) else -1


def kill_once(program, scene, folder, steps, pause):
    """Start a run, kill it `pause` seconds after so many steps, and return the last step in `statistics`."""
    process = subprocess.Popen(
        [program, scene, "--output", folder, "--set", "Time/End=1e6", "--set",
         f"Output/checkpoint/Interval={INTERVAL}"],
        env=scene_tools.environment(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    start = time.monotonic()
    while n_steps(folder) < steps and process.poll() is None and time.monotonic() < start + PATIENCE:
        time.sleep(0.01)
    time.sleep(pause)
    process.send_signal(signal.SIGKILL)
    if process.wait() != -signal.SIGKILL:
        sys.exit(f"the run has ended by itself, with exit code {process.returncode}")
    if n_steps(folder) < steps:
        sys.exit(f"no {steps} steps in {PATIENCE} s")
    if not os.path.exists(os.path.join(folder, "statistics")):
        return 0
    names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    if any(len(row) != len(names) for row in rows):
        sys.exit("statistics holds a row that is not whole")
    return int(rows[-1][0]) if rows else 0


def check_lists(folder):
    """Lists of ParaView are valid and name files that are there; returns how many files."""
    named = [entry.getAttribute("file") for name in glob.glob(os.path.join(folder, "*.pvd"))
             for entry in xml.dom.minidom.parse(name).getElementsByTagName("DataSet")]
    missing = [name for name in named if not os.path.exists(os.path.join(folder, name))]
    if missing:
        sys.exit(f"a list of ParaView names {missing}")
    return len(named)


def resume(program, folder, last_step):
    """The first new step after resuming."""
    scene_tools.run(program, ["resume", folder, "--set", f"Time/Maximum steps={last_step + 2}"])
    _, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    steps = [int(row[0]) for row in rows]
    if steps != list(range(last_step + 3)):
        sys.exit(f"after resuming, statistics holds the steps {steps}")
    with open(os.path.join(folder, "log.txt")) as log:
        resumed = [line for line in log if line.startswith("resumed at step")]
    return int(resumed[-1].split()[3].rstrip(","))


def main():
    program, scene = sys.argv[1:3]
    kills = int(sys.argv[3]) if len(sys.argv) > 3 else 20
    generator = random.Random(1)
    resumed = n_pictures = 0
    for number in range(kills):
        # One in ten falls into the start.
        steps, pause = generator.randint(0, MOST_STEPS) if number % 10 else -1, generator.uniform(0, MORE)
        with tempfile.TemporaryDirectory() as folder:
            last_step = kill_once(program, scene, folder, steps, pause)
            n_pictures += check_lists(folder)
            if last_step <= INTERVAL:
                continue  # killed before the first checkpoint, which follows its row, was written
            start = resume(program, folder, last_step)
            if not last_step - INTERVAL <= start <= last_step:
                sys.exit(f"killed after step {last_step}, resumed at {start}: "
                         f"more than {INTERVAL} steps are lost")
            resumed += 1
    if resumed < kills // 2:
        sys.exit(f"only {resumed} of {kills} kills came after the first checkpoint")
    if n_pictures < kills // 2:
        sys.exit(f"only {n_pictures} files of pictures in {kills} runs")
    print(f"{kills} kills, {resumed} resumed, none lost more than {INTERVAL} steps; {n_pictures} pictures")


main()
