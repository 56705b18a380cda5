# SPDX-License-Identifier: LGPL-2.1-or-later
"""Energies that a run shows, and the work that was put in, from where bodies are."""
import dataclasses

import law_outline

ENERGIES = ("Fluid kinetic energy", "solid kinetic energy", "solid elastic energy")


def energies(run):
    """Kinetic and elastic energy of fluid and bodies in every row [J]. What contact stores is left out, which makes a
    bound from above only milder."""
    if not run.columns:
        return []
    of_fluid, *of_bodies = ENERGIES
    columns = [run.columns[name] for name in (*([of_fluid] if of_fluid in run.columns else []), *of_bodies)]
    return [sum(values) for values in zip(*columns)]


@dataclasses.dataclass(frozen=True)
class LoadedBody:
    """A body, what it weighs, and what the fluid meets of it."""
    name: str
    density: float  # at rest [kg/m^dim]
    outline: law_outline.Outline
    load: tuple = (0.0, 0.0)  # dead force per volume at rest, constant [N/m^dim]

    def depths(self, run, surface):
        """Of every row: the integral of surface - y over what the body takes below that height [m^(dim+1)]."""
        places = self.outline.places(run)
        for at, expected in zip(places[:1], run.columns[f"volume {self.name}"]):
            if abs(self.outline.volume(at) - expected) > 1e-6 * expected:
                raise ValueError(f"the outline of body {self.name} takes {self.outline.volume(at)} m^dim instead of {expected}")
        return [self.outline.depth(at, surface) for at in places]

    def centres(self, run, axis):
        return run.column(f"centre of mass {self.name} {axis}")


@dataclasses.dataclass(frozen=True)
class Surroundings:
    """A fluid of which the surface, where the pressure is zero, lies at the height `surface`."""
    density: float  # [kg/m^dim]
    gravity: float  # downwards [m/s^2]
    surface: float  # [m]

    def settings(self, sides):
        """Openings of the fluid at these sides, with the pressure of the fluid at rest: there the reduced one is the
        same everywhere."""
        result = {"Fluid/Boundaries/opening": {
            "Sides": sides, "Kind": "pressure", "Pressure": repr(self.density * self.gravity * self.surface)}}
        if self.gravity > 0:
            result["Effects/gravity"] = {"Acceleration": f"0, {-self.gravity!r}"}
        return result


def works(run, bodies, around):
    """The work of gravity, of the pressure at openings and of dead loads since the start, in every row [J].

    What a body gains in height the fluid loses: gravity's work on the fluid and that of the pressure at the openings is
    together what it takes to bring the body's volume from the surface to its depth."""
    result = [0.0] * len(run.times())
    for body in bodies:
        depths, xs, ys = body.depths(run, around.surface), body.centres(run, "x"), body.centres(run, "y")
        if not depths:
            continue
        rest_volume = run.column(f"volume {body.name}")[0]
        mass = body.density * rest_volume
        for row, depth in enumerate(depths):
            result[row] += around.gravity * (around.density * (depths[0] - depth) - mass * (ys[row] - ys[0]))
            result[row] += rest_volume * (body.load[0] * (xs[row] - xs[0]) + body.load[1] * (ys[row] - ys[0]))
    return result
