#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The memory of a run stays constant over thousands of steps.

usage: check_memory.py PROGRAM SCENE.prm ["Section/Key=value"]... [--steps N] [--table]

Watches what the process itself has asked for (anonymous resident memory, without libraries and files) while it takes
2000 steps, and fails if the most that it holds in the last quarter of the run is larger than in the second quarter by
more than 128 kB, which is a leak of 0.13 kB in a step. Frames and checkpoints are written on the way. Linux only.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
import time

import scene_tools

PAUSE = 0.005  # seconds between looks
BOUND = 128  # kB
# The allocator of glibc gives all but small blocks back as soon as they are freed: else the start of a run, which
# needs more than its steps, leaves room in which leaks would not be seen.
ALLOCATOR = {"MALLOC_MMAP_THRESHOLD_": "16384", "MALLOC_MMAP_MAX_": "1000000",
             "MALLOC_TRIM_THRESHOLD_": "0", "MALLOC_TOP_PAD_": "0", "MALLOC_ARENA_MAX": "1"}


def resident(process):
    """Anonymous resident memory [kB], or None if the process has ended."""
    try:
        with open(f"/proc/{process.pid}/smaps_rollup") as file:
            found = re.search(r"^Anonymous:\s*(\d+) kB", file.read(), re.M)
    except OSError:
        return None
    return int(found[1]) if found else None


class Rows:
    """Counts the rows of `statistics` while they are written."""

    def __init__(self, path):
        self.path, self.file, self.count = path, None, 0

    def last_step(self):
        if self.file is None:
            if not os.path.exists(self.path):
                return 0
            self.file = open(self.path)
        self.count += sum(line.endswith("\n") and not line.startswith("#") for line in self.file)
        return max(0, self.count - 1)


def watch(command, folder):
    """The largest memory [kB] seen in each step, by the step's number."""
    process = subprocess.Popen(command, env=dict(scene_tools.environment(), **ALLOCATOR), stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
    rows, largest = Rows(os.path.join(folder, "statistics")), {}
    while process.poll() is None:
        step, memory = rows.last_step(), resident(process)
        if memory is not None:
            largest[step] = max(largest.get(step, 0), memory)
        time.sleep(PAUSE)
    if process.returncode != 0:
        sys.exit(f"exit code {process.returncode}\n{process.stderr.read()}")
    return largest


def largest_between(largest, window):
    values = [memory for step, memory in largest.items() if window[0] <= step < window[1]]
    if not values:
        sys.exit(f"the run was too fast to be watched between steps {window[0]} and {window[1]}")
    return max(values)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("settings", nargs="*")
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("--table", action="store_true", help="print the memory in parts of the run")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        command = [given.program, given.scene, "--output", folder]
        for setting in given.settings + ["Time/End=1e6", f"Time/Maximum steps={given.steps}"]:
            command += ["--set", setting]
        largest = watch(command, folder)
    if given.table:
        for part in range(20):
            window = (part * given.steps // 20, (part + 1) * given.steps // 20)
            print(f"steps from {window[0]}: {largest_between(largest, window)} kB")
    early = largest_between(largest, (given.steps // 4, given.steps // 2))
    late = largest_between(largest, (3 * given.steps // 4, given.steps))
    growth = late - early
    print(f"{early} kB in the second quarter of {given.steps} steps, {late} kB in the last")
    if growth > BOUND:
        sys.exit(f"memory has grown by {growth} kB, {2 * growth / given.steps:.2f} kB in a step; "
                 f"allowed are {BOUND} kB")


main()
