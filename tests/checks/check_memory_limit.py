#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes that are too large are found out before they take memory, and runs that run out of it say so.

usage: check_memory_limit.py PROGRAM PRM_FOLDER [--long]

With less and less memory allowed, a run ends well, then for want of memory with exit code 6 and a
message, then is refused before it begins with exit code 2 and what would fit. A short test looks
for one limit of the second kind, on two ranks; a long one steps down through all of them, in several
scenes on one and two ranks.
"""
import os
import re
import subprocess
import sys
import tempfile

import scene_tools

MEMORY = 6  # exit codes
REFUSED = 2
SECONDS = 60  # of the processor, after which a process is killed: it would fill its memory
PEAK = 300e6  # [bytes]
HUGE = {"plume.prm": "Domain/Cells=400, 625, 400", "cavity.prm": "Domain/Cells=10000, 10000",
        "dam_break_impact_particles_3d.prm": "Particles/Spacing=0.001",
        "cantilever.prm": "Bodies/beam/Cells=1000, 100, 100"}


def limited(limit, command):
    """`command` with at most `limit` bytes of data for each rank."""
    return ["sh", "-c", f'ulimit -t {SECONDS} && ulimit -d {int(limit / 1024)} && exec "$0" "$@"'] + command


def run(program, scene, settings, ranks=1, limit=None, more=()):
    """Exit code, what was printed, largest memory of a process [bytes]."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, scene, "--output", os.path.join(folder, "results"), *more]
        for setting in settings:
            command += ["--set", setting]
        command = limited(limit, command) if limit else command
        if ranks > 1:
            command = ["mpirun", "-np", str(ranks)] + command
        with open(os.path.join(folder, "printed"), "w+") as printed:
            process = subprocess.Popen(command, env=scene_tools.environment(), stdout=printed,
                                       stderr=subprocess.STDOUT)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            printed.seek(0)
            text = printed.read()
        return process.returncode, text, 1024 * usage.ru_maxrss


def expect(holds, what, text):
    if not holds:
        sys.exit(f"{what}\n{text[-3000:]}")


def check_huge_scenes(program, folder):
    """1e8 cells or particles, or so many elements, on a machine that lets a process have 4 GB."""
    for name, setting in HUGE.items():
        scene = os.path.join(folder, name)
        code, text, peak = run(program, scene, [setting], limit=4e9, more=["--validate"])
        what = f"{name} --validate: exit code {code}, {peak / 1e6:.0f} MB"
        expect(code == 0 and "warning: memory may not suffice" in text and "not checked" in text,
               f"{what}: must warn", text)
        expect(peak < PEAK, f"{what}: takes too much", text)

        code, text, peak = run(program, scene, [setting], limit=4e9)
        what = f"{name}: exit code {code}, {peak / 1e6:.0f} MB"
        expect(code == REFUSED and "too large for this machine" in text and " fit" in text,
               f"{what}: must be refused", text)
        expect(peak < PEAK, f"{what}: takes too much", text)

        for more in [], ["--validate"]:
            code, text, _ = run(program, scene, [setting, "Time/Endd=1"], limit=4e9, more=more)
            expect(code == REFUSED and "Endd" in text, f"{name}: mistakes are to be found first",
                   text)


class LimitedRuns:
    """Short runs of one scene with limits of memory."""

    def __init__(self, program, scene, setting, ranks):
        self.name = f"{os.path.basename(scene)} on {ranks} rank(s)"
        self.arguments = (program, scene,
                          [setting, "Time/Maximum steps=2", "Output/Parts=statistics"], ranks)
        code, text, self.peak = run(*self.arguments)
        expect(code == 0, f"{self.name} must run", text)

    def code(self, limit):
        """The exit code, after its message has been looked at."""
        code, text, _ = run(*self.arguments, limit)
        what = f"{self.name} with {limit / 1e6:.0f} MB each: exit code {code}"
        expect(code in (0, MEMORY, REFUSED), what, text)
        expect(code != MEMORY or "out of memory" in text, f"{what} without a message", text)
        expect(code != REFUSED or re.search(r"too large for this machine.* fit", text, re.S),
               f"{what} without a message", text)
        return code


def check_less_and_less(runs):
    """Returns the exit codes that were met."""
    codes = []
    limit = 0.9 * runs.peak  # of which libraries are a part that the limit is not about
    while REFUSED not in codes[-1:] and limit > 3e7:
        codes.append(runs.code(limit))
        limit *= 0.87
    print(f"{runs.name}: {codes}")
    order = [0, MEMORY, REFUSED]
    expect(codes == sorted(codes, key=order.index), f"{runs.name}: exit codes {codes}", "")
    return set(codes)


def check_one_limit(runs):
    """Somewhere between what suffices and what is refused a run ends for want of memory."""
    lower, upper = 3e7, runs.peak
    for _ in range(8):
        limit = (lower * upper) ** 0.5
        code = runs.code(limit)
        if code == MEMORY:
            print(f"{runs.name}: out of memory with {limit / 1e6:.0f} MB each")
            return
        lower, upper = (limit, upper) if code == REFUSED else (lower, limit)
    sys.exit(f"{runs.name}: no limit between {lower / 1e6:.0f} and {upper / 1e6:.0f} MB was met "
             "during the run")


def main():
    program, folder = sys.argv[1:3]
    check_huge_scenes(program, folder)
    if "--long" not in sys.argv:
        check_one_limit(LimitedRuns(program, os.path.join(folder, "jet_two_sheets.prm"),
                                    "Domain/Cells=48, 24, 24", 2))
        return
    met = set()
    for name, setting, ranks in (("plume.prm", "Domain/Cells=48, 96, 48", 1),
                                 ("plume.prm", "Domain/Cells=48, 96, 48", 2),
                                 ("jet_two_sheets.prm", "Domain/Cells=48, 24, 24", 2),
                                 ("cantilever.prm", "Bodies/beam/Cells=32, 4, 6", 2),
                                 ("dam_break_particles.prm", "Particles/Spacing=0.146/96", 1)):
        met |= check_less_and_less(
            LimitedRuns(program, os.path.join(folder, name), setting, ranks))
    expect(met == {0, MEMORY, REFUSED}, f"only these exit codes were met: {met}", "")


main()
