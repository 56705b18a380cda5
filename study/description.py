# SPDX-License-Identifier: LGPL-2.1-or-later
"""A study as its file describes it; the program itself reads that file."""
import json
import os
import subprocess
import sys
from dataclasses import dataclass, field

from study.cases import AS_IS, QUANTITIES, RANKS

AXES = "xyz"
# Keys of a quantity that variations may change.
VARIABLE = ("Columns", "Factor", "Rate", "Rate over", "Evaluate", "Share of step", "From", "Until", "Periods", "Period of")
FIELD_COLUMNS = {"velocity": "velocity", "pressure": "pressure", "displacement": "displacement",
                 "body velocity": "velocity"}


@dataclass
class Variation:
    """Something that is varied: settings and a name for each of its values and, of a refinement or a range, numbers: lengths,
    or the values themselves."""
    name: str
    kind: str
    names: list
    settings: list  # a dictionary {"Section/Key": value} for each value
    lengths: list

    def is_refinement(self):
        return self.kind == "refinement"

    def is_range(self):
        return self.kind == "range"


@dataclass
class Quantity:
    """What is evaluated and what it should be, see `undine --reference`."""
    name: str
    columns: list
    factor: float
    unit: str
    evaluate: str
    share_of_step: float
    start: float
    until: float
    periods: int
    period_of: str
    field: str
    body: str
    lower: list
    upper: list
    n_points: list
    reference: list
    reference_file: str
    reference_column: str
    reference_row: dict
    reference_times: str
    reference_factor: float
    scale: float
    section: dict = field(default_factory=dict)  # that all of this is from
    folder: str = ""
    rate: bool = False
    rate_over: float = 0
    is_vector: bool = False  # columns are its components, instead of terms of a sum

    def has_reference(self):
        return bool(self.reference or self.reference_file)

    def in_case(self, settings):
        """What it is with the settings of a case, which may change some of its keys."""
        prefix = f"{QUANTITIES}{self.name}/"
        changed = {key[len(prefix):]: value for key, value in settings.items() if key.startswith(prefix)}
        return quantity(self.name, {**self.section, **changed}, self.folder) if changed else self

    def points(self):
        """Of a field, evenly distributed in its box."""
        result = [[]]
        for lower, upper, count in zip(self.lower, self.upper, map(int, self.n_points)):
            places = [lower + (upper - lower) * (k + 0.5) / count for k in range(count)]
            result = [point + [place] for point in result for place in places]
        return result

    def probe(self, k):
        """Name of the probe at one of the points."""
        return f"{self.name} {k}"

    def settings(self):
        """Probes at the points of a field."""
        result = {}
        if self.field:
            for k, point in enumerate(self.points()):
                section = f"Probes/{self.probe(k)}"
                result[f"{section}/Kind"] = "body point" if self.body else "fluid point"
                result[f"{section}/Point"] = ", ".join(map(repr, point))
                if self.body:
                    result[f"{section}/Body"] = self.body
        return result

    def components(self):
        """Columns of each component of the quantity at each place; those of one list are added up."""
        if not self.field:
            return [[name] for name in self.columns] if self.is_vector else [self.columns]
        suffixes = [""] if self.field == "pressure" else [f" {axis}" for axis in AXES[:len(self.lower)]]
        return [[f"{self.probe(k)} {FIELD_COLUMNS[self.field]}{suffix}"]
                for suffix in suffixes for k in range(len(self.points()))]


@dataclass
class Study:
    title: str
    file: str
    scene: str
    ranks: int
    repeat_below: float
    limit: float
    cost: str
    combine: str
    levels: list
    settings: dict
    variations: list
    quantities: list = field(default_factory=list)
    boundary: float = 1.2  # factor between neighbours of a range at which runs begin to be stable
    linear_theory: bool = False  # find where it foretells that

    def ranges(self):
        """Positions of the variations along which it matters whether runs are stable."""
        return [k for k, variation in enumerate(self.variations) if variation.is_range()]

    def refinements(self):
        """Positions of the variations that are refinements."""
        return [k for k, variation in enumerate(self.variations) if variation.is_refinement()]


def split(text, separator):
    return [part.strip() for part in text.split(separator)] if text.strip() else []


def numbers(text):
    return [float(word) for word in split(text, ",")]


def truth(text):
    if text not in ("true", "false"):
        raise ValueError(f"'{text}' is neither 'true' nor 'false'")
    return text == "true"


def flat(section, path=""):
    """{"Section/Key": text} of nested sections."""
    result = {}
    for key, value in section.items():
        if isinstance(value, dict):
            result.update(flat(value, f"{path}{key}/"))
        else:
            result[path + key] = value
    return result


def variation(name, section):
    values = {key: [part.strip() for part in text.split("|")] for key, text in flat(section["Settings"]).items()}
    settings = [dict(zip(values, combination)) for combination in zip(*values.values())]
    names = split(section["Names"], ",") or [next(iter(each.values())) or "none" for each in settings]
    return Variation(name, section["Kind"], names, settings, numbers(section["Lengths"]))


def row(text):
    """{column: value} of "column = value, ..."; ends the program."""
    parts = [[word.strip() for word in part.split("=", 1)] for part in split(text, ",")]
    if any(len(part) != 2 for part in parts):
        sys.exit(f"Error: 'Reference row = {text}': allowed are 'column = value', with ',' between")
    return dict(parts)


def quantity(name, section, folder):
    text = section.get
    file = os.path.normpath(os.path.join(folder, text("Reference file"))) if text("Reference file") else ""
    return Quantity(
        name, split(text("Columns"), ";"), float(text("Factor")), text("Unit"), text("Evaluate"),
        float(text("Share of step")), float(text("From")), float(text("Until")), int(text("Periods")), text("Period of"),
        "" if text("Field") == "none" else text("Field"), text("Body"), numbers(text("Lower corner")),
        numbers(text("Upper corner")), numbers(text("Points")), split(text("Reference"), ";"), file,
        text("Reference column"), row(text("Reference row")),
        text("Reference times"), float(text("Reference factor")), float(text("Scale")), section, folder,
        truth(text("Rate", "false")), float(text("Rate over", "0")))


def check_time_of_end(quantity):
    """The value at the end belongs to another time with each step where it is taken within a step."""
    if quantity.evaluate == "end" and quantity.share_of_step < 1 and not quantity.until:
        raise ValueError(f"'{quantity.name}': 'Evaluate = end' with 'Share of step' below 1 would compare values of different "
                         "times: give 'Until', a time before the last step of all runs")


def check_own_keys(study):
    """What the program cannot check, since it knows neither cases nor which keys are the study's own; ends the program."""
    for each in study.quantities:
        try:
            check_time_of_end(each)
        except ValueError as error:
            sys.exit(f"Error: {study.file}: {error}")
    allowed = {f"{QUANTITIES}{each.name}/{key}" for each in study.quantities for key in VARIABLE}
    for settings in [study.settings] + [each for variation in study.variations for each in variation.settings]:
        for key in settings:
            if key.startswith(QUANTITIES) and key not in allowed:
                sys.exit(f"Error: {study.file}: 'Settings' must not change '{key}'; allowed: {', '.join(sorted(allowed))}")
        own = {key: value for key, value in settings.items() if value != AS_IS}
        try:
            if int(own.get(RANKS, 1)) < 1:
                raise ValueError(f"'{RANKS} = {own[RANKS]}' must be at least 1")
            for each in study.quantities:
                check_time_of_end(each.in_case(own))
        except ValueError as error:
            sys.exit(f"Error: {study.file}: 'Settings' of {', '.join(settings)}: {error}")


def from_json(text, file):
    """The study that the program has read from a file."""
    top, folder = json.loads(text), os.path.dirname(os.path.abspath(file))
    study = Study(top["Title"], file, os.path.normpath(os.path.join(folder, top["Scene"])), int(top["Ranks"]),
                  float(top["Repeat below"]), float(top["Limit"]), top["Cost"], top["Combine"], numbers(top["Levels"]),
                  flat(top.get("Settings", {})),
                  [variation(*item) for item in top["Vary"].items()],
                  [quantity(*item, folder) for item in top.get("Quantities", {}).items()], float(top["Boundary within"]),
                  truth(top["Linear theory"]))
    for each in study.quantities:
        study.settings.update(each.settings())
    check_own_keys(study)
    return study


def read(program, file):
    """Read a study; a mistake in it ends the program with its message."""
    result = subprocess.run([program, "read-study", file], capture_output=True, text=True)
    if result.returncode != 0:
        sys.stderr.write(result.stderr)
        sys.exit(result.returncode)
    return from_json(result.stdout, file)
