# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sheets of any density, pushed together, close a region of fluid without shaking it."""
import math
import os

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
        return Plan([point(*chosen, QUICK_SETTINGS, QUICK_FINER) for chosen in QUICK])
    return Plan([point(density, per_second, {}, FINER) for density in DENSITIES for per_second in STEPS])
