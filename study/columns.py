# SPDX-License-Identifier: LGPL-2.1-or-later
"""The numbers that a run leaves in its files `statistics` and `timing`."""
import difflib
import re


class NotEvaluated(Exception):
    """Why a quantity has no value in a run."""


def parse(text):
    """Names of columns, their units, and the rows of numbers of a file `statistics`."""
    names, units, rows = [], [], []
    for line in text.splitlines():
        header = re.match(r"# *\d+: (.*) \[(.*)\]$", line)
        if header:
            names.append(header[1])
            units.append(header[2])
        elif line.strip() and not line.startswith("#"):
            rows.append([float(word) for word in line.split()])
    return names, units, rows


def read(path):
    """{name: values of all rows} of a file `statistics`."""
    import numpy  # checks that only parse do without it
    try:
        with open(path) as file:
            names, _, rows = parse(file.read())
    except (OSError, ValueError) as error:
        raise NotEvaluated(f"'{path}' cannot be read: {error}") from error
    if any(len(row) != len(names) for row in rows):
        raise NotEvaluated(f"'{path}' has rows of other lengths than its header")
    return dict(zip(names, numpy.array(rows).T))


def column(columns, name):
    if name not in columns:
        near = difflib.get_close_matches(name, columns, 3, 0.4)
        raise NotEvaluated(f"there is no column '{name}' in 'statistics'" +
                           (f"; similar: {', '.join(near)}" if near else ""))
    return columns[name]


def timing(path):
    """{phase: (calls, seconds)} of a file `timing`, names of nested phases joined by ' / '; nothing without the file."""
    result, above = {}, []
    try:
        with open(path) as file:
            lines = file.readlines()
    except OSError:
        return result
    for line in lines:
        row = re.match(r"( *)(\S.*?) +(\d+) +([\d.]+) +([\d.]+)$", line.rstrip())
        if row:
            above = above[:len(row[1]) // 2] + [row[2]]
            result[" / ".join(above)] = int(row[3]), float(row[4])
    return result


def phases(path):
    """{phase: seconds} of a file `timing`."""
    return {name: seconds for name, (_, seconds) in timing(path).items()}
