# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which plots the columns of `statistics` make: columns that differ in their component only share one, and so do energies."""
import re
from dataclasses import dataclass

NOT_DRAWN = ("Step", "Time")
LEDGER = re.compile(r"energy (by .*|gain)$")
ACCOUNT = re.compile(r"energy( put in.*| exchanged| created)?$")
CLOSURE = re.compile(r"(energy|momentum) closure$")
MOST_PLOTS = 40  # of one run; the names of further columns are listed


@dataclass
class Plot:
    """`names`: of columns, which are its curves; `labels`: what they are called in its legend."""
    section: str
    title: str
    unit: str
    names: list
    labels: list
    kind: str = "lines"  # or "steps" for whole numbers, "stack" for shares of a sum


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
    if LEDGER.match(name):
        return "Ledger", "Energy gained in a step, and from where", re.sub("energy (by )?", "", name), "stack"
    if name.startswith(("momentum by ", "momentum gain")):
        axis = f"Momentum along {component} gained in a step, and from where"
        return "Ledger", axis, base.replace("momentum by ", "").replace("momentum gain", "gain"), "stack"
    if CLOSURE.match(name):
        return "Ledger", "What the sums lack, as a share of what they add up", name, "lines"
    if ACCOUNT.match(name):
        return "Energies", "Account of the energy monitor", name, "lines"
    if unit == "J":
        return "Energies", "Energies", re.sub(r"(?i)( kinetic| elastic)? energy", r"\1", name).strip() or name, "lines"
    if name == "Step length":
        return "Steps", name, name, "lines"
    if "iterations" in name.lower():
        return "Steps", "Iterations", re.sub(r"(?i) iterations", "", name), "steps"
    if name == "Step cuts":
        return "Steps", name, name, "steps"
    return "Other columns", base, component or base, "lines"


SECTIONS = ("Probes", "Energies", "Steps", "Ledger", "Other columns")


def of_table(table, probes=()):
    """(plots, {name: value} of columns that never change, names for which there is no room)."""
    groups, constant = {}, {}
    for k, (name, unit) in enumerate(zip(table.names, table.units)):
        values = table.values[:, k]
        if name in NOT_DRAWN:
            continue
        section, title, label, kind = place_of(name, unit, probes)
        if kind != "stack" and len(values) and values.min() == values.max():
            constant[name] = values[0]
            continue
        plot = groups.setdefault((section, title, unit), Plot(section, title, unit, [], [], kind))
        plot.names.append(name)
        plot.labels.append(label)
    plots = sorted(groups.values(), key=lambda plot: SECTIONS.index(plot.section))
    left_out = [name for plot in plots[MOST_PLOTS:] for name in plot.names]
    return plots[:MOST_PLOTS], constant, left_out
