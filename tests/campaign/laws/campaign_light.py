# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies up to a thousand times lighter than the fluid, free or on a neck, rise with the energy that was put in."""
import dataclasses
import math
import os

import law_energy
import law_outline
import law_scenes
from law_report import Finding, Plan, Point, largest

GAIN = 0.01  # of the largest work put in, that the energy may have above the work so far
REDONE = 0.01  # of the steps
MOTION = 0.05  # of the largest displacement, from that in finer steps
LOSS = 0.05  # of the energy lost in a period in finer steps
FINER = 16
RESOLVED = 0.3  # omega h, up to which runs are compared with those in finer steps

FLUID = 1000.0  # kg/m^3
SURFACE = 1.0  # the fluid's height [m]
RATIOS = (1e-3, 1e-2, 0.1, 1.0)  # of the body's density to the fluid's
MODULI = (1e3, 1e4, 1e5, 1e6, 1e7)  # Pa
STEPS = (15, 30, 60, 120, 240, 480)  # in a second
END = 0.4  # s, with the gravity of the earth: a light body rises by half of the depth
END_IN_SPACE = 0.25  # s, there it rises faster
LOAD = 0.1  # pressure at the bottom over Young's modulus, at most; gravity is less for what is softer
EARTH = 9.81  # m/s^2

NECK = 0.05  # width [m]
ROW = 0.025  # height of the rows of cells of a body on a neck [m]


@dataclasses.dataclass(frozen=True)
class Shape:
    """A body at rest, by settings of its section; and its outline."""
    settings: dict
    outline: law_outline.Outline
    length: float  # its largest extent [m]
    dimension: int = 2


def box():
    lower, upper, cells = (0.3, 0.1), (0.7, 0.3), (8, 4)
    return Shape({"Shape": "box", "Lower corner": law_scenes.point(lower), "Upper corner": law_scenes.point(upper),
                  "Cells": "8, 4"}, law_outline.of_box("block", lower, upper, cells), 0.4)


def disc():
    centre, radius, refinements = (0.5, 0.22), 0.12, 2
    return Shape({"Shape": "ball", "Lower corner": None, "Upper corner": None, "Cells": None, "Centre": "0.5, 0.22",
                  "Radius": radius, "Refinements": refinements},
                 law_outline.of_ball("block", centre, radius, refinements), 2 * radius)


def on_neck(expression, width):
    """A body of the width `width(y)`, which `expression` is in a scene, that goes on below as a neck into the floor."""
    rows = 15
    lower, upper = (0.0, -2 * ROW), (1.0, (rows - 2) * ROW)
    outline = law_outline.of_box("block", lower, upper, (4, rows), lambda x, y: (0.5 + (x - 0.5) * width(y), y))
    return Shape({"Shape": "box", "Lower corner": law_scenes.point(lower), "Upper corner": law_scenes.point(upper),
                  "Cells": f"4, {rows}", "Map": f"0.5+(x-0.5)*{expression}; y",
                  "Boundaries/foot": {"Kind": "clamp", "Where": "-y"}}, outline, upper[1])


def box_on_neck():
    return on_neck(f"min(0.2, {NECK}+2*max(0, y-0.1))", lambda y: min(0.2, NECK + 2 * max(0.0, y - 0.1)))


def disc_on_neck():
    return on_neck(f"max({NECK}, 2*sqrt(max(0, 0.0144-(y-0.21)^2)))",
                   lambda y: max(NECK, 2 * math.sqrt(max(0.0, 0.0144 - (y - 0.21) ** 2))))


def box_in_space():
    lower, upper, cells = (0.3, 0.1, 0.3), (0.7, 0.3, 0.7), (3, 2, 3)
    return Shape({"Shape": "box", "Lower corner": law_scenes.point(lower), "Upper corner": law_scenes.point(upper),
                  "Cells": "3, 2, 3"}, law_outline.of_box_in_space("block", lower, upper, cells), 0.4, 3)


def ball():
    """A box of which every side is blown up to a part of a sphere."""
    centre, radius, cells = (0.5, 0.22, 0.5), 0.12, (3, 3, 3)
    lower, upper = ([x + sign * radius for x in centre] for sign in (-1, 1))

    def blown_up(*place):
        return tuple(x + (y - x) * math.sqrt(1 - (b * b + c * c) / 2 + b * b * c * c / 3)
                     for x, y, (b, c) in zip(centre, place, others(place)))

    def others(place):
        parts = [(y - x) / radius for x, y in zip(centre, place)]
        return [(parts[(axis + 1) % 3], parts[(axis + 2) % 3]) for axis in range(3)]

    def expression(axis):
        b, c = (f"(({'xyz'[k]}-{centre[k]})/{radius})^2" for k in ((axis + 1) % 3, (axis + 2) % 3))
        return f"{centre[axis]}+({'xyz'[axis]}-{centre[axis]})*sqrt(1-({b}+{c})/2+{b}*{c}/3)"

    return Shape({"Shape": "box", "Lower corner": law_scenes.point(lower), "Upper corner": law_scenes.point(upper),
                  "Cells": "3, 3, 3", "Map": "; ".join(expression(axis) for axis in range(3))},
                 law_outline.of_box_in_space("block", lower, upper, cells, blown_up), 2 * radius, 3)


SHAPES = {"block": box, "disc": disc, "block on a neck": box_on_neck, "disc on a neck": disc_on_neck,
          "block 3D": box_in_space, "ball 3D": ball}
IN_SPACE = (("block 3D", 1e-3, 1e5), ("block 3D", 0.1, 1e6), ("ball 3D", 1e-3, 1e5), ("ball 3D", 1e-2, 1e6))
QUICK = (("block", 1e-3, 1e5, 60), ("block", 1e-3, 1e7, 30), ("block", 1e-2, 1e4, 60), ("disc", 1e-3, 1e5, 120),
         ("disc", 0.1, 1e6, 60), ("disc", 1.0, 1e3, 30), ("block on a neck", 1e-3, 1e5, 60),
         ("disc on a neck", 1e-2, 1e5, 60), ("block 3D", 1e-3, 1e5, 30), ("ball 3D", 1e-2, 1e6, 60))


@dataclasses.dataclass(frozen=True)
class Case:
    """A shape, the ratio of its density to the fluid's, Young's modulus [Pa] and the number of steps in a second."""
    shape_name: str
    ratio: float
    modulus: float
    per_second: int

    def __str__(self):
        return f"{self.shape_name}, density ratio {self.ratio:g}, {self.modulus:.0e} Pa, 1/{self.per_second} s"

    def shape(self):
        return SHAPES[self.shape_name]()

    def around(self):
        return law_energy.Surroundings(FLUID, min(EARTH, LOAD * self.modulus / (FLUID * SURFACE)), SURFACE)

    def frequency(self):
        """About that of the body's first longitudinal mode, in fluid that moves with it, omega [1/s]."""
        return math.pi / self.shape().length * math.sqrt(self.modulus / (FLUID * (1 + self.ratio)))

    def energies_and_works(self, run):
        body = law_energy.LoadedBody("block", self.ratio * FLUID, self.shape().outline)
        return law_energy.energies(run), law_energy.works(run, [body], self.around())


def scene_of(case, end, cells):
    """Without convection, damping and whatever the file measures."""
    shape, fluid = case.shape(), case.around()
    body = {f"Bodies/block/{key}": value for key, value in shape.settings.items()}
    space = {} if shape.dimension == 2 else {
        "Dimension": 3, "Domain/Lower corner": "0, 0, 0", "Domain/Upper corner": "1, 1, 1",
        "Effects/gravity/Acceleration": f"0, {-fluid.gravity!r}, 0",
        "Solid numerics/Element degree": 1}
    return law_scenes.with_settings(
        law_scenes.read(os.path.join(law_scenes.SCENES, "light_block_rises.prm")), body,
        {"Effects/convection": None, "Fluid/Boundaries/top": None, "Output/Budget": "false"}, fluid.settings("top"),
        space, shape.outline.settings(),
        {"Domain/Cells": ", ".join([str(cells)] * shape.dimension), "Bodies/block/Density": case.ratio * FLUID,
         "Bodies/block/Young's modulus": case.modulus, "Time/Step": f"1/{case.per_second}",
         "Time/End": end * math.sqrt(EARTH / fluid.gravity)})


def heights(run):
    return run.column("centre of mass block y")


def lost(energies, works):
    """Of the energy that was put in, at the end, as a share of the largest work."""
    return (energies[0] + works[-1] - energies[-1]) / largest(works)


def measure(program, case, scene, finer):
    run = program.run(scene)
    energies, works = case.energies_and_works(run)
    finding = Finding(str(case), {}, [], [run.scene])
    finding.need_end(run)
    if not energies:
        return finding
    most = largest(works)
    gain = largest(energy - energies[0] - work for energy, work in zip(energies, works))
    finding.figures.update({"most work [J]": most, "most energy [J]": largest(energies), "gain / work": gain / most
                            if most > 0 else math.inf, "rise [m]": heights(run)[-1] - heights(run)[0],
                            "redone": run.redone()})
    finding.need(gain <= GAIN * most, "more energy than was put in")
    finding.need(run.redone() <= REDONE, "steps redone")
    if finer and not run.complaint:
        compare(finding, run, program, case, scene, finer)
    return finding


def compare(finding, run, program, case, scene, finer):
    """Where the body is at the end, and the energy lost in a period, with those in finer steps, where the step resolves
    the body's first mode."""
    omega = case.frequency()
    finding.figures["omega h"] = omega / case.per_second
    if finding.figures["omega h"] > RESOLVED:
        return
    fine = program.run(law_scenes.with_settings(scene, {"Time/Step": f"1/{finer * case.per_second}"}))
    if fine.complaint:
        finding.need(False, f"the run with h/{finer}: {fine.complaint}")
        return
    way = largest(abs(height - heights(fine)[0]) for height in heights(fine))
    difference = abs(heights(run)[-1] - heights(fine)[-1]) / way if way > 0 else 0.0
    periods = max(1.0, omega * run.times()[-1] / (2 * math.pi))
    losses = [lost(*case.energies_and_works(one)) / periods for one in (run, fine)]
    finding.figures.update({f"motion off h/{finer}": difference, "lost in a period": losses[0],
                            f"lost with h/{finer}": losses[1]})
    finding.need(difference <= MOTION, f"motion is not that with h/{finer}")
    finding.need(abs(losses[0] - losses[1]) <= LOSS * abs(losses[1]), f"the energy lost is not that with h/{finer}")


def point(case, end, cells, finer):
    scene = scene_of(case, end, cells)
    return Point(str(case), lambda program: measure(program, case, scene, finer))


def plan(options):
    finer = FINER if options.against_fine else None
    if options.quick:
        return Plan([point(Case(*chosen), END / 4, 8 if "3D" in chosen[0] else 24, finer) for chosen in QUICK])
    plane = [(shape, ratio, modulus) for shape in SHAPES if "3D" not in shape for ratio in RATIOS for modulus in MODULI]
    return Plan([point(Case(*chosen, per_second), END, 32, finer) for chosen in plane for per_second in STEPS]
                + [point(Case(*chosen, per_second), END_IN_SPACE, 12, finer) for chosen in IN_SPACE for per_second in STEPS])
