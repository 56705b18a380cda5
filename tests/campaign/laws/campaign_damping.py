# SPDX-License-Identifier: LGPL-2.1-or-later
"""Damping only takes energy: dry bodies by every integrator in steps of all lengths, each with and without it."""
import os

import law_energy
import law_scenes
from law_report import Finding, Plan, Point, largest

ROUNDING = 1e-12  # of the largest energy, that damping may add in a step
MORE = 1e-6  # of the energy at the start, that a run with damping may have above one without it

STEPS = (15, 30, 60, 120, 240, 480)  # in a second
INTEGRATORS = {
    "trapezoid_bdf2": {"Time/Integrator": "trapezoid_bdf2"},
    "theta 0.6": {"Time/Integrator": "theta", "Time/Theta": 0.6},
    "theta 1": {"Time/Integrator": "theta", "Time/Theta": 1},
    "newmark 1/2": {"Time/Integrator": "newmark", "Time/Gamma": 0.5},
    "newmark 0.6": {"Time/Integrator": "newmark", "Time/Gamma": 0.6},
    "generalised_alpha": {"Time/Integrator": "generalised_alpha"},
}
CASES = {  # file and settings
    "thin strip": ("strip_swings.prm", {"Bodies/sheet/Upper corner": "0.00042, 0.65"}),
    "thick strip": ("strip_swings.prm", {"Bodies/sheet/Upper corner": "0.02, 0.65"}),
    "column": ("column_buckles.prm", {}),
    "ball": ("ball_rings.prm", {}),
}
QUICK = (("thin strip", "trapezoid_bdf2", 60), ("thin strip", "theta 0.6", 60), ("thin strip", "newmark 1/2", 60),
         ("thick strip", "trapezoid_bdf2", 15), ("thick strip", "generalised_alpha", 60), ("column", "theta 0.6", 30),
         ("column", "trapezoid_bdf2", 60), ("column", "newmark 0.6", 60), ("ball", "trapezoid_bdf2", 30),
         ("ball", "newmark 1/2", 30))
QUICK_END = 0.2


def measure(program, name, scene):
    damped = program.run(scene)
    free = program.run(law_scenes.with_settings(scene, {"Effects/damping": None}))
    energies, free_energies = law_energy.energies(damped), law_energy.energies(free)
    finding = Finding(name, {}, [], [damped.scene, free.scene])
    if not energies or not free_energies:
        finding.need_end(free if energies else damped)
        return finding
    start, most = energies[0], largest(energies)
    excess = max(0.0, largest(free_energies) - start)
    added = largest(damped.column("energy by damping"))
    finding.figures.update({
        "start [J]": start, "most with damping / start": most / start, "without": largest(free_energies) / start,
        "most added by damping / most": added / most, "redone": damped.redone(),
        "ends": "both" if not damped.complaint + free.complaint else "none" if damped.complaint and free.complaint
                else "without damping" if damped.complaint else "with damping"})
    finding.need(added <= ROUNDING * most, "damping adds energy")
    finding.need(most <= (1 + MORE) * start + excess, "more energy than at the start and without damping")
    if not free.complaint:
        finding.need_end(damped)
    return finding


def point(case, integrator, per_second, more):
    file, settings = CASES[case]
    scene = law_scenes.with_settings(law_scenes.read(os.path.join(law_scenes.SCENES, file)), settings,
                                     INTEGRATORS[integrator], {"Time/Step": f"1/{per_second}"}, more)
    name = f"{case}, {integrator}, 1/{per_second} s"
    return Point(name, lambda program: measure(program, name, scene))


def plan(options):
    if options.quick:
        return Plan([point(*chosen, {"Time/End": QUICK_END}) for chosen in QUICK])
    return Plan([point(case, integrator, per_second, {})
                 for case in CASES for integrator in INTEGRATORS for per_second in STEPS])
