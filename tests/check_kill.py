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
LONGEST = 4.0  # wall seconds before the kill


def kill_once(program, scene, folder, pause):
    """Start a run, kill it after `pause` seconds, and return the last step in `statistics`."""
    process = subprocess.Popen(
        [program, scene, "--output", folder, "--set", "Time/End=1e6", "--set",
         f"Output/checkpoint/Interval={INTERVAL}"],
        env=scene_tools.environment(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(pause)
    process.send_signal(signal.SIGKILL)
    process.wait()
    path = os.path.join(folder, "statistics")
    if not os.path.exists(path):
        return 0
    names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    if any(len(row) != len(names) for row in rows):
        sys.exit("statistics holds a row that is not whole")
    return int(rows[-1][0]) if rows else 0


def resume(program, folder, last_step):
    """The first new step after resuming; checks what the kill left behind."""
    for name in glob.glob(os.path.join(folder, "*.pvd")):
        xml.dom.minidom.parse(name)
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
    resumed = 0
    for number in range(kills):
        pause = generator.uniform(0.2, LONGEST)
        with tempfile.TemporaryDirectory() as folder:
            last_step = kill_once(program, scene, folder, pause)
            if last_step <= INTERVAL:
                continue  # killed before the first checkpoint, which follows its row, was written
            start = resume(program, folder, last_step)
            if start < last_step - INTERVAL:
                sys.exit(f"killed after step {last_step}, resumed at {start}: "
                         f"more than {INTERVAL} steps are lost")
            resumed += 1
    if resumed < kills // 2:
        sys.exit(f"only {resumed} of {kills} kills came after the first checkpoint")
    print(f"{kills} kills, {resumed} resumed, none lost more than {INTERVAL} steps")


main()
