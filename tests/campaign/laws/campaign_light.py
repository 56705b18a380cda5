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
FINER = 16

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
    dimension: int = 2


def box():
    lower, upper, cells = (0.3, 0.1), (0.7, 0.3), (8, 4)
    return Shape({"Shape": "box", "Lower corner": law_scenes.point(lower), "Upper corner": law_scenes.point(upper),
                  "Cells": "8, 4"}, law_outline.of_box("block", lower, upper, cells))


def disc():
    centre, radius, refinements = (0.5, 0.22), 0.12, 2
    return Shape({"Shape": "ball", "Lower corner": None, "Upper corner": None, "Cells": None, "Centre": "0.5, 0.22",
                  "Radius": radius, "Refinements": refinements},
                 law_outline.of_ball("block", centre, radius, refinements))


def on_neck(expression, width):
    """A body of the width `width(y)`, which `expression` is in a scene, that goes on below as a neck into the floor."""
    rows = 15
    lower, upper = (0.0, -2 * ROW), (1.0, (rows - 2) * ROW)
    outline = law_outline.of_box("block", lower, upper, (4, rows), lambda x, y: (0.5 + (x - 0.5) * width(y), y))
    return Shape({"Shape": "box", "Lower corner": law_scenes.point(lower), "Upper corner": law_scenes.point(upper),
                  "Cells": f"4, {rows}", "Map": f"0.5+(x-0.5)*{expression}; y",
                  "Boundaries/foot": {"Kind": "clamp", "Where": "-y"}}, outline)


def box_on_neck():
    return on_neck(f"min(0.2, {NECK}+2*max(0, y-0.1))", lambda y: min(0.2, NECK + 2 * max(0.0, y - 0.1)))


def disc_on_neck():
    return on_neck(f"max({NECK}, 2*sqrt(max(0, 0.0144-(y-0.21)^2)))",
                   lambda y: max(NECK, 2 * math.sqrt(max(0.0, 0.0144 - (y - 0.21) ** 2))))


def box_in_space():
    return Shape({"Shape": "box", "Lower corner": "0.3, 0.1, 0.3", "Upper corner": "0.7, 0.3, 0.7",
                  "Cells": "3, 2, 3"}, None, 3)


def ball():
    return Shape({"Shape": "ball", "Lower corner": None, "Upper corner": None, "Cells": None,
                  "Centre": "0.5, 0.22, 0.5", "Radius": 0.12, "Refinements": 0}, None, 3)


SHAPES = {"block": box, "disc": disc, "block on a neck": box_on_neck, "disc on a neck": disc_on_neck,
          "block 3D": box_in_space, "ball 3D": ball}
IN_SPACE = (("block 3D", 1e-3, 1e5), ("block 3D", 0.1, 1e6), ("ball 3D", 1e-3, 1e5), ("ball 3D", 1e-2, 1e6))
QUICK = (("block", 1e-3, 1e5, 60), ("block", 1e-3, 1e7, 30), ("block", 1e-2, 1e4, 60), ("disc", 1e-3, 1e5, 120),
         ("disc", 0.1, 1e6, 60), ("disc", 1.0, 1e3, 30), ("block on a neck", 1e-3, 1e5, 60),
         ("disc on a neck", 1e-2, 1e5, 60), ("block 3D", 1e-3, 1e5, 30), ("ball 3D", 1e-2, 1e6, 60))


def around(modulus):
    return law_energy.Surroundings(FLUID, min(EARTH, LOAD * modulus / (FLUID * SURFACE)), SURFACE)


def scene_of(shape, ratio, modulus, per_second, end, cells):
    """Without convection, damping and whatever the file measures."""
    fluid = around(modulus)
    body = {f"Bodies/block/{key}": value for key, value in shape.settings.items()}
    space = {} if shape.dimension == 2 else {
        "Dimension": 3, "Domain/Lower corner": "0, 0, 0", "Domain/Upper corner": "1, 1, 1",
        "Effects/gravity/Acceleration": f"0, {-fluid.gravity!r}, 0",
        "Solid numerics/Element degree": 1}  # their volume is that of the outline which the fluid meets
    return law_scenes.with_settings(
        law_scenes.read(os.path.join(law_scenes.SCENES, "light_block_rises.prm")), body,
        {"Effects/convection": None, "Fluid/Boundaries/top": None, "Output/Budget": "false"}, fluid.settings("top"),
        space, shape.outline.settings() if shape.outline else {},
        {"Domain/Cells": ", ".join([str(cells)] * shape.dimension), "Bodies/block/Density": ratio * FLUID,
         "Bodies/block/Young's modulus": modulus, "Time/Step": f"1/{per_second}",
         "Time/End": end * math.sqrt(EARTH / fluid.gravity)})


def heights(run):
    return run.column("centre of mass block y")


def measure(program, name, shape, scene, ratio, modulus, finer):
    run = program.run(scene)
    body = law_energy.LoadedBody("block", ratio * FLUID, outline=shape.outline)
    energies, works = law_energy.energies(run), law_energy.works(run, [body], around(modulus))
    finding = Finding(name, {}, [], [run.scene])
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
        compare(finding, run, program.run(law_scenes.with_settings(
            scene, {"Time/Step": f"({law_scenes.value_of(scene, 'Time/Step')})/{finer}"})), finer)
    return finding


def compare(finding, run, fine, finer):
    """Where the body is at the end, with where it is in finer steps."""
    if fine.complaint:
        finding.need(False, f"the run with h/{finer} stops")
        return
    way = largest(abs(height - heights(fine)[0]) for height in heights(fine))
    difference = abs(heights(run)[-1] - heights(fine)[-1]) / way if way > 0 else 0.0
    finding.figures[f"motion off h/{finer}"] = difference
    finding.need(difference <= MOTION, f"motion is not that with h/{finer}")


def point(shape_name, ratio, modulus, per_second, end, cells, finer):
    shape = SHAPES[shape_name]()
    scene = scene_of(shape, ratio, modulus, per_second, end, cells)
    name = f"{shape_name}, density ratio {ratio:g}, {modulus:.0e} Pa, 1/{per_second} s"
    return Point(name, lambda program: measure(program, name, shape, scene, ratio, modulus, finer))


def plan(options):
    finer = FINER if options.against_fine else None
    if options.quick:
        return Plan([point(*chosen, END / 4, 8 if "3D" in chosen[0] else 24, finer) for chosen in QUICK])
    plane = [(shape, ratio, modulus) for shape in SHAPES if "3D" not in shape for ratio in RATIOS for modulus in MODULI]
    return Plan([point(*chosen, per_second, END, 32, finer) for chosen in plane for per_second in STEPS]
                + [point(*chosen, per_second, END_IN_SPACE, 12, finer) for chosen in IN_SPACE for per_second in STEPS])
