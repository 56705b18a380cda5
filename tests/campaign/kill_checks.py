# SPDX-License-Identifier: LGPL-2.1-or-later
"""What must hold of the folder of a run that was stopped, and of one that was resumed and has reached its end."""
import os
import sys
import xml.etree.ElementTree

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "checks"))
import scene_tools  # noqa: E402

TOLERANCE = 1e-8  # of the largest number of a unit, on other numbers of ranks
ROUNDING = 1e-12  # in any unit: what solvers leave where a sum should be zero, of terms around one
FOREIGN = ("notes.txt", "solution/notes.txt", "checkpoint/notes.txt")
FOREIGN_TEXT = "not of this run\n"
SLOTS = ("checkpoint/slot_0.h5", "checkpoint/slot_1.h5")  # either or both


class Wrong(Exception):
    """Something that must not happen has happened."""


def add_foreign_files(folder):
    for name in FOREIGN:
        path = os.path.join(folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w") as file:
            file.write(FOREIGN_TEXT)


def check_foreign_files(folder):
    for name in FOREIGN:
        try:
            with open(os.path.join(folder, name)) as file:
                kept = file.read() == FOREIGN_TEXT
        except OSError:
            kept = False
        if not kept:
            raise Wrong(f"the foreign file {name} is gone or changed")


def last_step(folder):
    """Of the last row of `statistics`; 0 without rows. Every row must be whole, and none missing or twice."""
    path = os.path.join(folder, "statistics")
    if not os.path.exists(path):
        return 0
    text = scene_tools.statistics(folder)
    if text and not text.endswith("\n"):
        raise Wrong(f"statistics ends within a row: {text.splitlines()[-1]!r}")
    names, _, rows = scene_tools.parse(text)
    for number, row in enumerate(rows):
        if len(row) != len(names) or row[0] != number:
            raise Wrong(f"row {number} of statistics is that of step {row[0]:g} "
                        f"and has {len(row)} of {len(names)} columns")
    return int(rows[-1][0]) if rows else 0


def files_named_in(path):
    """By a list of ParaView, relative to its folder. Throws ParseError if it is no valid XML."""
    root = xml.etree.ElementTree.parse(path).getroot()
    if path.endswith(".pvd"):
        return [entry.get("file") for entry in root.iter("DataSet")]
    return [entry.text.strip().partition(":")[0] for entry in root.iter("DataItem")
            if entry.get("Format") == "HDF"]


def check_lists(folder):
    for name in ("solution.pvd", "solution.xdmf"):
        path = os.path.join(folder, name)
        if not os.path.exists(path):
            continue
        try:
            names = files_named_in(path)
        except xml.etree.ElementTree.ParseError as error:
            raise Wrong(f"{name} is no valid XML: {error}") from error
        for named in names:
            if not os.path.exists(os.path.join(folder, named)):
                raise Wrong(f"{name} names {named}, which does not exist")


def check_stopped(folder):
    """A run that was stopped by anything; returns the step of its last row."""
    check_foreign_files(folder)
    check_lists(folder)
    return last_step(folder)


def result_files(folder):
    """Names of all files below the folder but checkpoints and the foreign ones."""
    names = (os.path.relpath(os.path.join(place, name), folder)
             for place, _, files in os.walk(folder) for name in files)
    return sorted(set(names) - set(FOREIGN + SLOTS))


def check_frames(folder, reference):
    """What the run shows of itself is that of the uninterrupted run to the bit."""
    for name in result_files(reference):
        if not name.endswith((".vtu", ".pvd", ".xdmf")):
            continue
        with open(os.path.join(folder, name), "rb") as one:
            with open(os.path.join(reference, name), "rb") as other:
                if one.read() != other.read():
                    raise Wrong(f"{name} is not that of the uninterrupted run")


def check_finished(folder, reference, same_ranks):
    """A run that was resumed and has reached its end, against the folder of one that was not interrupted."""
    check_foreign_files(folder)
    check_lists(folder)
    last_step(folder)
    names, expected = set(result_files(folder)), set(result_files(reference))
    if names != expected:
        raise Wrong(f"files left over: {sorted(names - expected)}, missing: "
                    f"{sorted(expected - names)}")
    text, record = scene_tools.statistics(folder), scene_tools.statistics(reference)
    if same_ranks:
        if text != record:
            rows = [number for number, (one, other) in
                    enumerate(zip(text.splitlines(), record.splitlines())) if one != other]
            raise Wrong(f"statistics differs from that of the uninterrupted run in {len(rows)} "
                        f"lines, the first is {rows[:1]}")
        check_frames(folder, reference)
    found = scene_tools.differences(text, record, TOLERANCE, False, ROUNDING)
    if found:
        raise Wrong(found[0])
