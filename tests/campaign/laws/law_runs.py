# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of the program."""
import dataclasses
import json
import os
import re
import subprocess
import sys
import tempfile
import time

import law_scenes

sys.path.insert(0, os.path.join(law_scenes.ROOT, "tests", "checks"))
import scene_tools  # noqa: E402

REFUSED = 2  # exit code of a scene that is wrong


@dataclasses.dataclass(frozen=True)
class Run:
    """What one run has left."""
    columns: dict  # of `statistics`, by name; empty if it did not begin
    complaint: str  # why it stopped, empty if it reached its end
    was_refused: bool  # before it began
    scene: str  # the text of its file
    summary: dict = dataclasses.field(default_factory=dict)  # summary.json; empty if there is none
    seconds: float = 0.0

    def column(self, name):
        return self.columns.get(name, [])

    def times(self):
        return self.column("Time")

    def redone(self):
        """The share of steps that were cut and carried out again."""
        if not self.columns:
            return 0
        cuts, steps = sum(self.columns["Step cuts"]), len(self.times()) - 1
        return cuts / max(1, cuts + steps)


def columns_of(folder):
    """Of `statistics`, by name; without what a run that was ended has written of its last row."""
    try:
        text = scene_tools.statistics(folder)
    except OSError:
        return {}
    names, _, rows = scene_tools.parse(text[:text.rfind("\n") + 1])
    return dict(zip(names, map(list, zip(*rows))))


def summary_of(folder):
    try:
        with open(os.path.join(folder, "summary.json")) as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def complaint(code, text):
    """The first sentence of the program's message, without which step failed and where in the body; of a scene that is
    refused the first mistake."""
    mistake = re.search(r"(?:^|Error: )\S+?\.prm(?::\d+)?: (.*)", text, re.M)
    if code == REFUSED and mistake:
        return mistake[1][:100]
    error = re.search(r"Error: (?:[^\n]*?the last one of [^:]*: )?(?:body .*?the point that rests at .*?: )?(.*)", text)
    return re.split(r"[:;] |\.(?: |$)", error[1])[0][:100] if error else f"exit code {code}, no message"


class Program:
    """Carries out scenes, from several threads at once."""

    def __init__(self, path, limit, settings=None):
        """`limit`: seconds after which a run is ended; `settings` of all scenes. Exits if there is no such program."""
        self.path, self.limit = os.path.abspath(path), limit
        self.settings = {**law_scenes.QUIET, **(settings or {})}
        if not os.access(self.path, os.X_OK):
            sys.exit(f"{path} is no program")
        self.runs = []  # seconds of all runs so far

    def run(self, scene):
        """Of a nested dictionary."""
        text = law_scenes.text(law_scenes.with_settings(scene, self.settings))
        with tempfile.TemporaryDirectory() as folder:
            path, results = os.path.join(folder, "scene.prm"), os.path.join(folder, "results")
            with open(path, "w") as file:
                file.write(text)
            start = time.monotonic()
            code, printed = self.start([self.path, path, "--output", results])
            self.runs.append(time.monotonic() - start)
            columns, summary, seconds = columns_of(results), summary_of(results), self.runs[-1]
        why = "" if code == 0 else f"no end within {self.limit:g} s" if code is None else complaint(code, printed)
        return Run(columns, why, code == REFUSED, text, summary, seconds)

    def start(self, command):
        """Exit code, None if it was ended, and what was printed."""
        try:
            result = subprocess.run(command, env=scene_tools.environment(), capture_output=True, text=True,
                                    errors="replace", timeout=self.limit)
        except subprocess.TimeoutExpired:
            return None, ""
        return result.returncode, result.stdout + result.stderr
