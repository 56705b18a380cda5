#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What scenes say of their time and size at their head, and whether it is still true.

tests/scenes/costs.csv has for every scene what the whole run and its first two steps have cost, measured together in core
seconds, how fast the machine was then, and the bytes of the results. check_scene.py compares two steps with these two, on a
machine as fast: like with like, so that neither a busy machine nor a scene whose later steps are dearer is taken for a
change. Bytes are those of the last of two steps' pictures, times the number of pictures.

usage: scene_costs.py PROGRAM SCENE.prm... [--limit SECONDS]     measure, write costs.csv and the heads of the scenes
       scene_costs.py PROGRAM SCENE.prm... --check               are the heads true?

What takes longer than the limit is stopped, and goes on costing what its steps but the first two have cost.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import time

import scene_tools

TABLE = pathlib.Path(scene_tools.ROOT, "tests", "scenes", "costs.csv")
COLUMNS = ("scene", "core seconds", "bytes", "core seconds of two steps", "seconds of the yardstick",
           "share of the run that was made")
HEAD = re.compile(r"^# Takes about (\S+ (?:s|min|h)) on one core and writes about (\S+ (?:MB|GB))\.$", re.M)
ENDS = (0, 3, 7)  # exit codes: at the end, where a scene shows that a step fails, stopped
DEARER, CHEAPER = 3, 5  # than what the table has: processors are not equally fast at the yardstick and at scenes
PREFACE = """# Written by tests/checks/scene_costs.py, which says what it means. Core seconds of whole runs of mok_channel, turek_hron_cfd
# and _fsi, elastic_plate_cross_flow and pressure_pulse_tube are those of doc/viscous_flows.md, in which they were measured; those of
# at_rest, body_against_wall_3d, fifty_bodies_3d, folding_sheet_3d, inflated_sphere and two_hundred_bodies are of doc/hard_cases.md.
"""
LEAST_SECONDS, LEAST_BYTES = 0.3, 1.5e6  # of two steps, of results: less is not told apart
ENDS_EARLY = {"jet_two_sheets_split_2d"}  # a step fails, which is what they show: fewer results than their time asks for


def yardstick():
    """Core seconds of a fixed piece of work, the least of some: how slow this machine is now."""
    import numpy
    values = numpy.linspace(0, 1, 200000)
    least = math.inf
    for _ in range(3):
        begin = time.process_time()
        for _ in range(2):
            numpy.sort(numpy.sin(1e5 * values)).cumsum()
        least = min(least, time.process_time() - begin)
    return least


def cost_of(folder):
    """Core seconds, steps and what has been reached of a finished or stopped run."""
    with open(os.path.join(folder, "summary.json")) as file:
        summary = json.load(file)
    with open(os.path.join(folder, "parameters.json")) as file:
        parameters = json.load(file)
    return summary["cost"]["core seconds"], summary["steps"], summary["time [s]"] / float(parameters["Time"]["End"])


def rows():
    with open(TABLE) as file:
        return {row["scene"]: row for row in csv.DictReader(line for line in file if not line.startswith("#"))}


def in_words(seconds, size):
    """("3 min", "40 MB"), rounded so that they can be remembered."""
    unit, length = ("s", 1) if seconds < 100 else ("min", 60) if seconds < 6000 else ("h", 3600)
    number = max(1, float(f"{seconds / length:.1g}" if seconds / length < 10 else f"{seconds / length:.2g}"))
    megabytes = max(1, float(f"{size / 1e6:.2g}"))
    return f"{number:.0f} {unit}", f"{megabytes:.0f} MB" if megabytes < 1000 else f"{megabytes / 1000:.1f} GB"


def name_of(scene):
    return pathlib.Path(scene).stem


def faults(scene, folder):
    """What is no longer true at the head of the scene, of which two steps were run in the folder."""
    row = rows().get(name_of(scene))
    if row is None:
        return [f"tests/scenes/costs.csv has no row '{name_of(scene)}': scene_costs.py makes one"]
    head = HEAD.search(pathlib.Path(scene).read_text())
    wanted = in_words(float(row["core seconds"]), float(row["bytes"]))
    if head is None or head.groups() != wanted:
        return [f"the head of {name_of(scene)} must say '# Takes about {wanted[0]} on one core and writes about {wanted[1]}.'"]
    seconds, _, _ = cost_of(folder)
    slowness = yardstick() / float(row["seconds of the yardstick"])
    found = []
    for what, value, before in (
            ("two steps take {:.2g} times the core seconds", max(seconds / slowness, LEAST_SECONDS),
             max(float(row["core seconds of two steps"]), LEAST_SECONDS)),
            ("results take {:.2g} times the bytes", max(whole_size(folder), LEAST_BYTES), max(float(row["bytes"]), LEAST_BYTES))):
        if "bytes" in what and name_of(scene) in ENDS_EARLY:
            continue
        if not before / CHEAPER < value < before * DEARER:
            found.append(f"{what.format(value / before)} that tests/scenes/costs.csv has: the scene's head is not true")
    return found


def core_seconds_of(process):
    """Until now."""
    with open(f"/proc/{process.pid}/stat") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def run(program, scene, folder, limit, *settings):
    """Run a scene, stopped after `limit` core seconds; returns whether it was stopped."""
    process = subprocess.Popen([program, scene, "--output", folder, *settings], env=scene_tools.environment(),
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while process.poll() is None:
        time.sleep(0.2)
        if limit and process.poll() is None and core_seconds_of(process) > limit:
            process.send_signal(signal.SIGTERM)
            process.wait()
    if process.returncode not in ENDS:
        raise RuntimeError(f"{scene}: exit code {process.returncode}")
    return process.returncode == 7


def whole_size(folder):
    """Bytes of the whole run, by what a part of it has left: as many pictures as the scene asks for, each as large as the last
    one, a row for each step, and two checkpoints."""
    path = pathlib.Path(folder)
    with open(path / "parameters.json") as file:
        parameters = json.load(file)
    end, step = (float(parameters["Time"][key]) for key in ("End", "Step"))
    interval = float(parameters["Output"]["Interval"])
    last = max((file.stem.rpartition("_")[2] for file in path.glob("solution/*.vtu")), default="none")
    picture = sum(file.stat().st_size for file in path.glob(f"solution/*_{last}.vtu"))
    rows_of_part = [line for line in scene_tools.statistics(folder).splitlines() if not line.startswith("#")]
    checkpoint = max((file.stat().st_size for file in path.glob("checkpoint/*")), default=0)
    pictures = 1 + (math.ceil(end / interval * (1 - 1e-9)) if interval else 1)
    return pictures * picture + math.ceil(end / step) * len(rows_of_part[-1]) + 2 * checkpoint


def measured(program, scene, limit, short):
    """A row of the table."""
    with tempfile.TemporaryDirectory() as folder:
        run(program, scene, folder + "/two", None, *short)
        seconds_of_two, steps_of_two, _ = cost_of(folder + "/two")
        scale, whole = yardstick(), folder + "/whole"
        stopped = run(program, scene, whole, limit and limit + seconds_of_two)
        seconds, steps, share = cost_of(whole)
        share = share if stopped else 1
        if steps > steps_of_two:  # the first steps are dearer than those after them
            seconds += (seconds - seconds_of_two) / (steps - steps_of_two) * steps * (1 / share - 1)
        return dict(zip(COLUMNS, (name_of(scene), f"{seconds:.3g}", f"{whole_size(whole):.3g}",
                                  f"{seconds_of_two:.3g}", f"{scale:.3g}", f"{share:.2g}")))


def write_table(table):
    with open(TABLE, "w") as file:
        file.write(PREFACE)
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(table[name] for name in sorted(table))


def write_head(scene, row):
    """Put the line at the end of the first comment of the scene."""
    text = HEAD.sub("", pathlib.Path(scene).read_text()).lstrip("\n")
    line = "# Takes about {} on one core and writes about {}.\n".format(*in_words(float(row["core seconds"]), float(row["bytes"])))
    comment = re.match(r"(#[^\n]*\n)*", text).end()
    pathlib.Path(scene).write_text(text[:comment] + line + text[comment:].lstrip("\n"))


def check(program, scenes, settings):
    """Two steps of each."""
    found = []
    for scene in scenes:
        with tempfile.TemporaryDirectory() as folder:
            run(program, scene, folder + "/two", None, *settings(scene))
            found += faults(scene, folder + "/two")
    if found:
        raise SystemExit("\n".join(found))


def main():
    import check_scene
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--limit", type=float)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    if options.check:
        check(options.program, options.scenes, check_scene.settings)
        return
    for scene in options.scenes:
        row = measured(options.program, scene, options.limit, check_scene.settings(scene))
        table = rows() if TABLE.exists() else {}
        table[row["scene"]] = row
        write_table(table)
        write_head(scene, row)
        print(", ".join(row.values()), flush=True)


if __name__ == "__main__":
    main()
