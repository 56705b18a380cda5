# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which plots the columns of `statistics` make: columns that differ in their component only share one, and so do energies."""
import re
from dataclasses import dataclass

NOT_DRAWN = ("Step", "Time")
BOOKED = re.compile(r"(energy|momentum) (?:by (.*)|(gain))$")
# What the budget books energy under, each step's sum being the gain (`BudgetTerm`); `energy by EFFECT` is a part of these.
TERMS = {"transport", "forces", "diffusion", "boundary values", "sides", "openings", "obstacles", "interface", "fluid at rest",
         "friction", "loads", "supports", "damping", "contact", "integrator", "sleep", "gain"}
ACCOUNT = re.compile(r"energy( put in.*| exchanged| created)?$")
CLOSURE = re.compile(r"(energy|momentum) closure$")
MOST_PLOTS = 40  # of one run; the names of further columns are listed


@dataclass
class Plot:
    """`names`: of columns, which are its curves; `labels`: what they are called in its legend; rows from `first` on."""
    section: str
    title: str
    unit: str
    names: list
    labels: list
    kind: str = "lines"  # or "steps" for whole numbers; of what is added up over time, "sums", or "stack" for shares of a sum
    first: int = 0

    def values(self, table, name):
        """What is drawn of a column."""
        column = table.column(name)[self.first:]
        return column.cumsum() if self.kind in ("sums", "stack") else column


def split_component(name):
    """"tip velocity x" is a component of "tip velocity"; a scalar has none."""
    found = re.fullmatch(r"(.*?),? ([xyz])", name)
    return (found[1], found[2]) if found else (name, "")


def probe_of(name, probes):
    """The longest name of a probe that the column begins with."""
    return max((probe for probe in probes if name == probe or name.startswith(probe + " ")), key=len, default="")


def place_of(name, unit, probes):
    """(section, title of the plot, label of the curve, kind)."""
    base, component = split_component(name)
    if probe_of(name, probes):
        return "Probes", base, component or base, "lines"
    booked = BOOKED.match(base)
    if booked:
        term, of_axis = booked[2] or booked[3], f" along {component}" if component else ""
        if term in TERMS:
            return "Ledger", f"{booked[1].capitalize()}{of_axis} gained since the start, by where it came from", term, "stack"
        return "Ledger", "Energy by effect", term, "sums"
    if CLOSURE.match(name):
        return "Ledger", "What the sums lack, as a share of what they add up", name, "lines"
    if ACCOUNT.match(name):
        return "Energies and steps", "Account of the energy monitor", name, "lines"
    if unit == "J":
        return "Energies and steps", "Energies", re.sub(r"(?i)( kinetic| elastic)? energy", r"\1", name).strip() or name, "lines"
    if name == "Step length":
        return "Energies and steps", name, name, "lines"
    if "iterations" in name.lower():
        return "Energies and steps", "Iterations", re.sub(r"(?i) iterations", "", name), "steps"
    if name == "Step cuts":
        return "Energies and steps", name, name, "steps"
    return "Other columns", base, component or base, "lines"


SECTIONS = ("Probes", "Energies and steps", "Ledger", "Other columns")


def first_row(table, name):
    """The initial state knows nothing of steps."""
    is_of_steps = name in ("Step length", "Step cuts") or "iterations" in name.lower()
    return 1 if is_of_steps and len(table) > 1 and "Step" in table and table.column("Step")[0] == 0 else 0


def of_table(table, probes=()):
    """(plots, {name: value} of columns that never change, names for which there is no room)."""
    groups, constant = {}, {}
    for name, unit in zip(table.names, table.units):
        if name in NOT_DRAWN:
            continue
        section, title, label, kind = place_of(name, unit, probes)
        first = first_row(table, name)
        values = table.column(name)[first:]
        if len(values) and values.min() == values.max() and (kind not in ("sums", "stack") or values[0] == 0):
            constant[name] = values[0]
            continue
        plot = groups.setdefault((section, title, unit), Plot(section, title, unit, [], [], kind, first))
        plot.names.append(name)
        plot.labels.append(label)
    plots = sorted(groups.values(), key=lambda plot: (SECTIONS.index(plot.section), plot.title != "Energies"))
    left_out = [name for plot in plots[MOST_PLOTS:] for name in plot.names]
    return plots[:MOST_PLOTS], constant, left_out
