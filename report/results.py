# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run has left in its folder. Each file may be missing, torn or spoilt: what cannot be read is noted, never fatal."""
import json
import math
import os
import re
import socket

import numpy

from study import columns


class Table:
    """The file `statistics`: a row for the initial state and for every step."""

    def __init__(self, names=(), units=(), rows=()):
        self.names, self.units = list(names), list(units)
        self.values = numpy.array(list(rows), dtype=float).reshape(len(rows), len(self.names))

    def column(self, name):
        """Values of all rows."""
        return self.values[:, self.names.index(name)]

    def __contains__(self, name):
        return name in self.names

    def __len__(self):
        return len(self.values)


class Results:
    """`problems`: a sentence for each file that is there but cannot be used as a whole."""

    def __init__(self, folder):
        self.folder = os.fspath(folder)
        self.problems = []
        self.summary = self._json("summary.json")
        self.effects = self._json("effects.json")
        self.parameters = self._json("parameters.json")
        self.statistics = self._statistics()
        said = [line for line in self.text("record.txt").splitlines() if line.startswith("run ")]
        self.has_ended = said[-1:] == ["run has ended"]
        if self.has_process() and not self.is_of_this_process("summary.json"):
            self.summary = {}  # of the run before, which this one continues

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def has(self, name):
        return os.path.exists(self.path(name))

    def text(self, name):
        """Of a file; empty without it."""
        try:
            with open(self.path(name), encoding="utf-8", errors="replace") as file:
                return file.read()
        except FileNotFoundError:
            return ""
        except OSError as error:
            self.problems.append(f"'{name}' cannot be read: {error.strerror}")
            return ""

    def attempt(self, file, make, otherwise):
        """make(self), or `otherwise` where the file has other contents than is expected, as older or spoilt ones may."""
        try:
            return make(self)
        except (AttributeError, IndexError, KeyError, TypeError, ValueError):
            self.problems.append(f"'{file}' has other contents than this version of Undine writes; what they tell is left out")
            return otherwise

    def title(self):
        return str(self.summary.get("title") or self.parameters.get("Title") or os.path.basename(os.path.abspath(self.folder)))

    def probes(self):
        """Their names."""
        probes = self.parameters.get("Probes", {})
        return list(probes) if isinstance(probes, dict) else []

    def dimension(self):
        try:
            return int(self.summary.get("dimension") or self.parameters.get("Dimension"))
        except (TypeError, ValueError):
            return 3

    def is_running(self):
        """Its process lives, and has not said yet that the run is over."""
        return self.has_process() and not self.has_ended and not self.summary.get("failure")

    def is_of_this_process(self, name):
        """Is the file younger than the lock?"""
        return self.has(name) and os.path.getmtime(self.path(name)) >= os.path.getmtime(self.path("lock"))

    def has_process(self):
        """As its lock says; of a run on another host that cannot be known, so it counts as there."""
        found = re.search(r"^host (\S+)\nprocess (\d+)$", self.text("lock"), re.M)
        return bool(found) and (found[1] != socket.gethostname() or os.path.exists(f"/proc/{found[2]}"))

    def _json(self, name):
        text = self.text(name)
        try:
            found = json.loads(text) if text else {}
        except ValueError as error:
            self.problems.append(f"'{name}' is no JSON: {error}")
            return {}
        if not isinstance(found, dict):
            self.problems.append(f"'{name}' holds no object")
            return {}
        return found

    def _statistics(self):
        header, rows, spoilt = [], [], 0
        for line in self.text("statistics").splitlines():
            (header if line.startswith("#") else rows).append(line)
        names, units, _ = columns.parse("\n".join(header))
        kept = []
        for row in rows:
            try:
                numbers = [float(word) for word in row.split()]
            except ValueError:
                numbers = []
            if len(numbers) == len(names) and all(map(math.isfinite, numbers)):
                kept.append(numbers)
            else:
                spoilt += 1
        if rows and not names:
            self.problems.append("'statistics' has no names of columns at its top, so its rows cannot be used")
            return Table()
        if spoilt:
            self.problems.append(f"'statistics': {spoilt} of {len(rows)} rows are torn or no numbers, and left out")
        return Table(names, units, kept)
