# SPDX-License-Identifier: LGPL-2.1-or-later
"""What campaigns measure, as they hand it over, and how it is shown."""
import dataclasses
import json
import math
import os
import re


@dataclasses.dataclass(frozen=True)
class Point:
    """One place in the space of what a campaign varies."""
    name: str
    measure: object  # a function of a `Program` that returns a `Finding`


@dataclasses.dataclass(frozen=True)
class Plan:
    """What a campaign does."""
    points: list
    summary: object = lambda findings: []  # more findings, about several points, once all are measured


@dataclasses.dataclass
class Finding:
    """What was measured at a point."""
    name: str
    figures: dict  # numbers and texts by what they are
    broken: list  # texts, one for each bound that is broken
    scenes: list = dataclasses.field(default_factory=list)  # texts of the files that were run

    def need(self, holds, law):
        """Notes the law, a text, if it does not hold. A comparison with what is not a number must be false."""
        if not holds:
            self.broken.append(law)

    def need_end(self, run):
        if run.complaint:
            last = run.times()[-1] if run.times() else 0
            self.broken.append(f"stops at {last:.3g} s: {run.complaint}")


def largest(numbers):
    """nan if there is one, and for no numbers."""
    numbers = list(numbers)
    return max(numbers) if numbers and not any(map(math.isnan, numbers)) else math.nan


def shown(value):
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def table(findings):
    """A line for each."""
    names = list(dict.fromkeys(name for finding in findings for name in finding.figures))
    rows = [["point"] + names + ["broken"]]
    rows += [[finding.name] + [shown(finding.figures[name]) if name in finding.figures else "" for name in names]
             + ["; ".join(finding.broken)] for finding in findings]
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]) - 1)] + [0]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows)


def finite(value):
    """JSON has no words for numbers that are none."""
    return repr(value) if isinstance(value, float) and not math.isfinite(value) else value


def write(folder, results):
    """laws.json with the figures of all campaigns, `results` by name, and the scenes of the points at which something
    is broken."""
    content = {}
    for campaign, findings in results.items():
        content[campaign] = [
            {"point": finding.name, "figures": {name: finite(value) for name, value in finding.figures.items()},
             "broken": finding.broken, "scenes": keep_scenes(folder, campaign, finding)} for finding in findings]
    with open(os.path.join(folder, "laws.json"), "w") as file:
        json.dump(content, file, indent=1)
        file.write("\n")


def keep_scenes(folder, campaign, finding):
    """Names of the files, relative to the folder."""
    if not finding.broken:
        return []
    names = []
    for number, text in enumerate(finding.scenes):
        name = re.sub(r"[^\w.]+", "_", finding.name) + (f"_{number}" if number else "") + ".prm"
        names.append(os.path.join(campaign, name))
        os.makedirs(os.path.join(folder, campaign), exist_ok=True)
        with open(os.path.join(folder, names[-1]), "w") as file:
            file.write(text)
    return names
