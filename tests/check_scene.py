#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run a scene for a few steps and compare its file `statistics` with a recorded one.

usage: check_scene.py PROGRAM SCENE.prm RECORD.output RANKS [--record]

The same record serves every number of ranks: a result must not depend on it. Two numbers are the
same if they differ by no more than TOLERANCE of the largest number of the same unit in the file
(so that rounding noise in a component that should be zero is measured by its neighbours).
Iteration counts may differ by ranks and are compared on one rank only, to within SLACK.
"""
import os
import re
import subprocess
import sys
import tempfile

TOLERANCE = 1e-7
SLACK = 2
STEPS = 2


def run(program, scene, ranks):
    """The text of `statistics` after STEPS steps."""
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1", OMP_NUM_THREADS="1")
    with tempfile.TemporaryDirectory() as folder:
        command = [program, scene, "--output", folder, "--set", f"Time/Maximum steps={STEPS}"]
        if ranks > 1:
            command = ["mpirun", "-np", str(ranks)] + command
        result = subprocess.run(command, env=environment, capture_output=True, text=True)
        if result.returncode != 0:
            sys.exit(f"exit code {result.returncode}\n{result.stdout}\n{result.stderr}")
        for expected in ("log.txt", "original.prm", "parameters.prm", "parameters.json", "timing"):
            if not os.path.exists(os.path.join(folder, expected)):
                sys.exit(f"the run did not write {expected}")
        with open(os.path.join(folder, "statistics")) as file:
            return file.read()


def parse(text):
    """Column names, their units, and the rows of numbers."""
    names, units, rows = [], [], []
    for line in text.splitlines():
        header = re.match(r"# *\d+: (.*) \[(.*)\]$", line)
        if header:
            names.append(header[1])
            units.append(header[2])
        elif line.strip() and not line.startswith("#"):
            rows.append([float(word) for word in line.split()])
    return names, units, rows


def compare(text, record, ranks):
    """A list of differences, one line each."""
    names, units, rows = parse(text)
    expected_names, expected_units, expected_rows = parse(record)
    if (names, units) != (expected_names, expected_units):
        return [f"columns differ: {names} {units}\nexpected {expected_names} {expected_units}"]
    if len(rows) != len(expected_rows):
        return [f"{len(rows)} rows instead of {len(expected_rows)}"]
    scale = {}
    for row in expected_rows:
        for unit, value in zip(units, row):
            scale[unit] = max(scale.get(unit, 0.0), abs(value))
    differences = []
    for number, (row, expected) in enumerate(zip(rows, expected_rows)):
        for name, unit, value, wanted in zip(names, units, row, expected):
            counted = "iterations" in name.lower()
            if counted and ranks > 1:
                continue
            allowed = SLACK if counted else TOLERANCE * scale[unit]
            if not abs(value - wanted) <= allowed:
                differences.append(f"row {number}, {name}: {value!r} instead of {wanted!r} "
                                   f"(allowed difference {allowed:.3g} {unit})")
    return differences


def main():
    program, scene, record, ranks = sys.argv[1:5]
    text = run(program, scene, int(ranks))
    if "--record" in sys.argv:
        with open(record, "w") as file:
            file.write(text)
        return
    with open(record) as file:
        differences = compare(text, file.read(), int(ranks))
    if differences:
        sys.exit("\n".join(differences[:20]))
    print(f"{os.path.basename(scene)} on {ranks} rank(s): as recorded")


main()
