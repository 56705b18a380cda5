# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the checks of whole runs share: starting the program and comparing `statistics`."""
import math
import os
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(ROOT)
from study.columns import parse  # noqa: E402
from study.runs import environment  # noqa: E402

SLACK = 2  # iterations
FEWER = 0.05  # of them, that a processor which rounds otherwise may need less
ROUNDING = 1e-13  # in any unit: what rounding leaves of numbers around one


def command(program, arguments, ranks):
    return (["mpirun", "-np", str(ranks)] if ranks > 1 else []) + [program] + arguments


def ended(program, arguments, ranks=1):
    """Exit code, output and errors of a run, however it ends."""
    result = subprocess.run(command(program, arguments, ranks), env=environment(),
                            capture_output=True, text=True)
    return result.returncode, result.stdout, result.stderr


def run(program, arguments, ranks=1):
    """Run to the end; raises RuntimeError with all that was printed if the exit code is not 0."""
    result = subprocess.run(command(program, arguments, ranks), env=environment(),
                            capture_output=True, text=True)
    if result.returncode != 0:
        raise RuntimeError(f"exit code {result.returncode} of {' '.join(arguments)}\n"
                           f"{result.stdout}\n{result.stderr}")
    return result


def statistics(folder):
    with open(os.path.join(folder, "statistics")) as file:
        return file.read()


def timed_columns(program, scene, settings):
    """The columns of `statistics` of a run with other settings ("Section/Key=value"), by name, and its wall seconds."""
    with tempfile.TemporaryDirectory() as folder:
        options = [scene, "--output", folder]
        for setting in settings:
            options += ["--set", setting]
        start = time.time()
        run(program, options)
        seconds = time.time() - start
        names, _, rows = parse(statistics(folder))
    return {name: [row[k] for row in rows] for k, name in enumerate(names)}, seconds


def differences(text, record, tolerance, compare_iterations, rounding=ROUNDING):
    """A list of differences, one line each. Two numbers are the same if they differ by no more than
    `rounding`, or than `tolerance` of the largest number of the same unit in the record: rounding
    noise in a component that should be zero is measured by its neighbours."""
    names, units, rows = parse(text)
    expected_names, expected_units, expected_rows = parse(record)
    if (names, units) != (expected_names, expected_units) or not names:
        return [f"columns differ: {names} {units}\nexpected {expected_names} {expected_units}"]
    if len(rows) != len(expected_rows) or not rows:
        return [f"{len(rows)} rows instead of {len(expected_rows)}"]
    if any(len(row) != len(names) or not all(map(math.isfinite, row)) for row in rows + expected_rows):
        return [f"a row lacks one of {len(names)} numbers"]
    scale = {}
    for row in expected_rows:
        for unit, value in zip(units, row):
            scale[unit] = max(scale.get(unit, 0.0), abs(value))
    result = []
    for number, (row, expected) in enumerate(zip(rows, expected_rows)):
        for name, unit, value, wanted in zip(names, units, row, expected):
            counted = "iterations" in name.lower()
            if counted and not compare_iterations:
                continue
            allowed = SLACK if counted else max(tolerance * scale[unit], rounding)
            if counted and value < wanted:
                allowed = max(SLACK, FEWER * wanted)
            if not abs(value - wanted) <= allowed:
                result.append(f"row {number}, {name}: {value!r} instead of {wanted!r} "
                              f"(allowed difference {allowed:.3g} {unit})")
    return result
