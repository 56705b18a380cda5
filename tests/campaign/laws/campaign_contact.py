# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sheets of any density, pushed together, close a region of fluid without shaking it; a sheet that folds does not pass
through itself, nor a block through a side of the domain, and neither gains energy."""
import math
import os

import law_energy
import law_scenes
from law_report import Finding, Plan, Point, largest

DIFFERENCE = 0.2  # of the fluid's largest energy from that with the finer steps
FINER = 16
QUICK_FINER = 2

DENSITIES = (1100, 300, 100, 30, 10, 3, 1)  # in water [kg/m^3]
STEPS = (30, 60, 120, 240, 480)  # in a second
# On a coarser grid, against steps of half the length.
QUICK = ((1100, 30), (300, 30), (100, 30), (10, 30), (1, 30))
QUICK_SETTINGS = {"Domain/Cells": "16, 16"}


# A free body that hits something: file, and settings of what is around it.
MORE = 1e-6  # of the energy at the start, that there may be later
DRY = {"Domain": None, "Fluid": None, "Effects/convection": None}
SHIFTS = {"on planes": 0.0, "off planes": 0.0137}  # [m]
HITS = {"sheet folds, dry": ("sheet_folds.prm", DRY)}
for shift_name, shift in SHIFTS.items():
    HITS[f"sheet folds, {shift_name}"] = ("sheet_folds.prm", {
        "Domain/Lower corner": f"{-0.8 + shift}, {-0.4 + shift}", "Domain/Upper corner": f"{0.8 + shift}, {1.2 + shift}"})
    block = {"Bodies/block/Lower corner": f"{0.2 + shift}, {0.3 + shift}",
             "Bodies/block/Upper corner": f"{0.5 + shift}, {0.6 + shift}"}
    HITS[f"block at a side, {shift_name}"] = ("block_meets_side.prm", {**block, "Effects/convection": None})
    HITS[f"block at a side, {shift_name}, convection"] = ("block_meets_side.prm", block)
QUICK_HITS = (("sheet folds, dry", 60), ("sheet folds, off planes", 60), ("block at a side, on planes", 60))


def measure_hit(program, name, scene):
    run = program.run(scene)
    finding = Finding(name, {}, [], [run.scene])
    finding.need_end(run)
    energies = law_energy.energies(run)
    if not energies:
        return finding
    contacts, gap = largest(run.column("nodes in contact")), min(run.column("least gap"))
    finding.figures.update({
        "most / start": largest(energies) / energies[0], "least gap [m]": gap, "nodes in contact": contacts,
        "redone": run.redone()})
    finding.need(contacts > 0, "nothing touches")
    finding.need(gap > 0, "a gap closes")
    finding.need(largest(energies) <= (1 + MORE) * energies[0], "more energy than at the start")
    return finding


def hit(case, per_second):
    file, settings = HITS[case]
    scene = law_scenes.with_settings(law_scenes.read(os.path.join(law_scenes.SCENES, file)), settings,
                                     {"Time/Step": f"1/{per_second}"})
    name = f"{case}, 1/{per_second} s"
    return Point(name, lambda program: measure_hit(program, name, scene))


def measure(program, name, scene, per_second, finer):
    coarse, fine = (program.run(law_scenes.with_settings(scene, {"Time/Step": f"1/{steps}"}))
                    for steps in (per_second, finer * per_second))
    finding = Finding(name, {}, [], [coarse.scene, fine.scene])
    most, expected = (largest(run.column("Fluid kinetic energy")) for run in (coarse, fine))
    finding.figures.update({
        "fluid's most [J]": most, f"with h/{finer} [J]": expected, "ratio": most / expected if expected else math.nan,
        "redone": coarse.redone(), "least gap [m]": min(coarse.column("least gap"), default=0.0),
        "fine run": fine.complaint or "ends"})
    finding.need_end(coarse)
    finding.need(abs(most - expected) <= DIFFERENCE * expected, f"fluid's energy is not that with h/{finer}")
    if fine.complaint:
        finding.need(False, f"the run with h/{finer} stops")
    return finding


def point(density, per_second, more, finer):
    scene = law_scenes.with_settings(
        law_scenes.read(os.path.join(law_scenes.SCENES, "contact_of_light_sheets.prm")), more,
        {f"Bodies/{side}/Density": density for side in ("left", "right")}, {"Output/Budget": "false"})
    name = f"{density} kg/m3, 1/{per_second} s"
    return Point(name, lambda program: measure(program, name, scene, per_second, finer))


def plan(options):
    if options.quick:
        return Plan([point(*chosen, QUICK_SETTINGS, QUICK_FINER) for chosen in QUICK]
                    + [hit(*chosen) for chosen in QUICK_HITS])
    return Plan([point(density, per_second, {}, FINER) for density in DENSITIES for per_second in STEPS]
                + [hit(case, per_second) for case in HITS for per_second in STEPS])
