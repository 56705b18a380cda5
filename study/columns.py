# SPDX-License-Identifier: LGPL-2.1-or-later
"""The numbers that a run leaves in its file `statistics`."""
import difflib
import re

import numpy


class NotEvaluated(Exception):
    """Why a quantity has no value in a run."""


def read(path):
    """{name: values of all rows} of a file `statistics`."""
    names = []
    with open(path) as file:
        for line in file:
            header = re.match(r"# *\d+: (.*) \[.*\]$", line)
            if header:
                names.append(header[1])
    rows = numpy.loadtxt(path, ndmin=2)
    if rows.shape[1:] != (len(names),):
        raise NotEvaluated(f"'{path}' has rows of other lengths than its header")
    return dict(zip(names, rows.T))


def column(columns, name):
    if name not in columns:
        near = difflib.get_close_matches(name, columns, 3, 0.4)
        raise NotEvaluated(f"there is no column '{name}' in 'statistics'" +
                           (f"; similar: {', '.join(near)}" if near else ""))
    return columns[name]
