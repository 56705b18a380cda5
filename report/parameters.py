# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parameters of a run: what the scene sets, and in what several runs differ."""
import re

from study.description import flat


def given(text):
    """[(section, key, value, unit)] of what the scene sets, of a file parameters.prm: defaults are comments there."""
    sections, found = [], []
    for line in text.splitlines():
        line = line.strip()
        if line.startswith("subsection "):
            sections.append(line[len("subsection "):].strip())
        elif line == "end" and sections:
            sections.pop()
        elif line.startswith("set "):
            assignment = re.fullmatch(r"set (.*?) *= ?(.*?)(?:  # \[(.*)\])?", line)
            if assignment:
                found.append((" / ".join(sections), assignment[1], assignment[2], assignment[3] or ""))
    return found


def differing(runs):
    """[("Section/Key", [value or "" of each run])] of parameters that are not the same in all runs; `runs`: parameters.json."""
    runs = [flat(run) for run in runs]
    names = dict.fromkeys(name for run in runs for name in run)
    rows = [(name, [run.get(name, "") for run in runs]) for name in names]
    return [row for row in rows if len(set(row[1])) > 1]
