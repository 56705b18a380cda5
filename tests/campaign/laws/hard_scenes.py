# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random scenes of what is hard, in the plane and in space: bodies that rise, sink, fall and drift, sheets that stand in streams and
under loads, plates between walls and over closed chambers, columns that buckle; of any density and stiffness."""
import dataclasses
import math
import random

import hard_ranges as ranges
import law_scenes


@dataclasses.dataclass(frozen=True)
class HardScene:
    name: str
    scene: dict
    figures: dict  # what was drawn, in numbers and words


def logarithmic(generator, bounds):
    return math.exp(generator.uniform(*map(math.log, bounds)))


class Surroundings:
    """Domain, grid, fluid and steps: what is drawn first, for all kinds of scenes."""

    def __init__(self, generator, dim, is_stream):
        self.generator, self.dim, self.is_stream = generator, dim, is_stream
        self.size = [1.5 if is_stream and axis == 0 else 1.0 for axis in range(dim)]
        self.grid = self.draw_grid()
        self.density = generator.choice(ranges.FLUIDS)
        self.per_second = generator.choice(ranges.STEPS)
        self.end = generator.randint(*ranges.STEPS_OF_A_RUN[dim]) / self.per_second
        self.on_planes = self.chance(ranges.ON_PLANES)
        self.poisson = (ranges.NEARLY_INCOMPRESSIBLE if self.chance(ranges.ALL_NEARLY_INCOMPRESSIBLE)
                        else generator.uniform(*ranges.POISSON))
        self.effects = self.draw_effects()
        self.openings = {"top": {"Sides": "top", "Kind": "pressure", "Pressure": "0"}}
        self.initial_velocity = None

    def chance(self, share):
        return self.generator.random() < share

    def draw_grid(self):
        while True:
            grid = [self.generator.randint(*ranges.GRID[self.dim]) for _ in range(self.dim)]
            if math.prod(grid) <= ranges.MOST_CELLS[self.dim]:
                return grid

    def draw_effects(self):
        effects = {"contact": {}}  # anything may meet
        if self.chance(ranges.WITH_CONVECTION):
            effects["convection"] = {}
        if self.chance(ranges.WITH_DAMPING):
            effects["damping"] = {"Stiffness coefficient": repr(logarithmic(self.generator, ranges.DAMPING))}
        if self.chance(ranges.WITH_FRICTION):
            viscosity = logarithmic(self.generator, ranges.FRICTION) * self.per_second * self.density
            effects["viscosity"] = {"Dynamic viscosity": repr(viscosity)}
        return effects

    def cell(self, axis):
        return self.size[axis] / self.grid[axis]

    def place(self, value, axis):
        """Where a face begins [m]."""
        return round(value / self.cell(axis)) * self.cell(axis) if self.on_planes else value

    def over_time(self, value):
        """An expression for what sets in, and may end again."""
        ramp = "1" if self.chance(ranges.SUDDEN) else f"min(1, {3 / self.end!r}*t)"
        if self.chance(ranges.SWITCHED_OFF):
            return f"if(t<{self.end / 2!r}, {value!r}*{ramp}, 0)"
        return f"{value!r}*{ramp}"

    def vector(self, components):
        return "; ".join(components[axis] if axis in components else "0" for axis in range(self.dim))

    def set_gravity(self, acceleration):
        if acceleration > 0:
            self.effects["gravity"] = {"Acceleration": ", ".join(
                repr(-acceleration) if axis == 1 else "0" for axis in range(self.dim))}

    def blow(self, speed, starts_moving):
        """A stream from left to right [m/s]."""
        flow = {0: repr(speed) if starts_moving else f"if(t>0, {self.over_time(speed)}, 0)"}
        self.openings = {"inlet": {"Sides": "left", "Kind": "inflow", "Velocity": self.vector(flow)},
                         "outlet": {"Sides": "right", "Kind": "outflow"}}
        self.initial_velocity = self.vector({0: repr(speed)}) if starts_moving else None

    def longest_stream(self):
        """So many cells a step [m/s]."""
        return ranges.MOST_CELLS_A_STEP * self.cell(0) * self.per_second


@dataclasses.dataclass
class Body:
    """A box as it is drawn, with its material."""
    lower: list
    upper: list
    cells: list
    density: float
    modulus: float
    settings: dict = dataclasses.field(default_factory=dict)

    def length(self, axis):
        return self.upper[axis] - self.lower[axis]

    def section(self, poisson):
        return {"Lower corner": law_scenes.point(self.lower), "Upper corner": law_scenes.point(self.upper),
                "Cells": ", ".join(map(str, self.cells)), "Density": repr(self.density), "Young's modulus": repr(self.modulus),
                "Poisson's ratio": repr(poisson), **self.settings}


class Bodies:
    """Draws them, into given surroundings."""

    def __init__(self, around):
        self.around, self.generator, self.dim = around, around.generator, around.dim

    def material(self):
        """Density and modulus."""
        ratio = logarithmic(self.generator, ranges.DENSITY_RATIO)
        return self.around.density * ratio, logarithmic(self.generator, ranges.MODULUS)

    def block(self, middle, most):
        """About this place, within a cube of this edge."""
        is_turned = not self.around.on_planes and self.around.chance(ranges.TURNED)
        most /= math.sqrt(self.dim) if is_turned else 1
        size = [most * self.generator.uniform(*ranges.BLOCK_SIZE) for _ in range(self.dim)]
        lower = [self.around.place(at - length / 2, axis) for axis, (at, length) in enumerate(zip(middle, size))]
        cells = [self.generator.randint(*ranges.BLOCK_CELLS[self.dim]) for _ in range(self.dim)]
        settings = {}
        if is_turned:
            settings["Rotation"] = ", ".join(repr(self.generator.uniform(-40, 40)) for _ in range(1 if self.dim == 2 else 3))
        return Body(lower, [low + length for low, length in zip(lower, size)], cells, *self.material(), settings)

    def thickness(self, axis):
        return logarithmic(self.generator, ranges.THICKNESS) * self.around.cell(axis)

    def sheet(self, at):
        """On the floor, in which one more cell of it is held; a thin wall across the stream."""
        height, along = self.generator.uniform(*ranges.SHEET_LENGTH), self.generator.randint(*ranges.CELLS_ALONG[self.dim])
        at, thickness = self.around.place(at, 0), self.thickness(0)
        body = Body([at, -height / along], [at + thickness, height], [1, along + 1], *self.material(),
                    {"Boundaries": {"foot": {"Kind": "clamp", "Where": "-y"}}})
        for _ in range(2, self.dim):
            width = self.generator.uniform(*ranges.SHEET_WIDTH)
            low, high = (-0.05, 1.05) if width > 0.95 else (0.5 - width / 2, 0.5 + width / 2)
            body.lower.append(low if width > 0.95 else self.around.place(low, 2))
            body.upper.append(high)
            body.cells.append(self.generator.randint(*ranges.CELLS_ALONG[self.dim]))
        return body

    def plate(self):
        """From wall to wall, in which one more cell of it is held."""
        at, thickness = self.around.place(self.generator.uniform(*ranges.PLATE_HEIGHT), 1), self.thickness(1)
        body = Body([], [], [], *self.material(), {"Boundaries": {"rim": {"Kind": "clamp", "Where": "max(-x, x-1)"}}})
        for axis in range(self.dim):
            along = self.generator.randint(*ranges.CELLS_ALONG[self.dim])
            body.lower.append(at if axis == 1 else -1 / along)
            body.upper.append(at + thickness if axis == 1 else 1 + 1 / along)
            body.cells.append(1 if axis == 1 else along + 2)
        return body

    def most_force(self, body, axis, length, fixed_ends):
        """Per volume, across a sheet or plate: what bends it by its length, or takes it so far, with the fluid around it, within
        the run [N/m^dim]."""
        thickness = body.length(axis)
        bending = (32 if fixed_ends == 2 else 2 / 3) * body.modulus * thickness ** 2 / length ** 3
        mass = body.density * thickness + self.around.density * length
        return min(bending + 2 * length * mass / (thickness * self.around.end ** 2), body.modulus / length)

    def share(self):
        return logarithmic(self.generator, ranges.LOAD)


def gravity_of(around, bodies, force, is_free):
    """With which weights, and those of what bodies displace, are this force per volume at most [m/s^2]."""
    heaviest = max([around.density, *(body.density for body in bodies)])
    squeezing = ranges.MOST_SQUEEZE * min(body.modulus for body in bodies) / (around.density * around.size[1])
    way = ranges.MOST_WAY / around.end ** 2 if is_free else math.inf
    return min(ranges.MOST_GRAVITY, force / heaviest, squeezing, way)


def rising_and_sinking(around, draw):
    """Free bodies, from one to a box full of them."""
    slots = ranges.SLOTS[around.dim]
    places = [[(number // slots ** axis % slots + 0.5) / slots for axis in range(around.dim)] for number in range(slots ** around.dim)]
    count = around.generator.randint(1, ranges.MOST_BODIES[around.dim])
    bodies = [draw.block(place, 1 / slots) for place in around.generator.sample(places, count)]
    force = draw.share() * min(body.modulus / body.length(1) for body in bodies)
    around.set_gravity(gravity_of(around, bodies, force, is_free=True))
    return bodies


def falling(around, draw):
    """A block on the floor."""
    body = draw.block([0.5] * around.dim, 0.5)
    lift = around.generator.uniform(*ranges.BLOCK_AT) - body.lower[1]
    if "Rotation" in body.settings:
        lift += sum(body.length(axis) for axis in range(around.dim) if axis != 1) / 2  # corners that turning lowers
    body.lower[1], body.upper[1] = body.lower[1] + lift, body.upper[1] + lift
    force = draw.share() * body.modulus / body.length(1)
    around.set_gravity(gravity_of(around, [body], force, is_free=False))
    return [body]


def drifting(around, draw):
    """A block comes in with the stream and goes on with it."""
    body = draw.block([around.generator.uniform(-0.2, 0.3), *[0.5] * (around.dim - 1)], 0.6)
    speed = min(around.longest_stream(), 1.2 / around.end,
                math.sqrt(draw.share() * body.modulus / max(body.density, around.density)))
    around.blow(speed, starts_moving=True)
    body.settings["Initial velocity"] = around.vector({0: repr(speed)})
    return [body]


def sheets(around, draw):
    first, apart = around.generator.uniform(*ranges.SHEETS_AT), around.generator.uniform(*ranges.SHEETS_APART)
    return [draw.sheet(first + number * apart) for number in range(around.generator.randint(1, ranges.MOST_SHEETS))]


def in_a_stream(around, draw):
    """Sheets on the floor."""
    bodies = sheets(around, draw)
    pressure = min(draw.share() * draw.most_force(body, 0, body.upper[1], 1) * body.length(0) for body in bodies)
    around.blow(min(around.longest_stream(), math.sqrt(pressure / around.density)), starts_moving=False)
    return bodies


def under_loads(around, draw):
    """Sheets on the floor, pushed each in its own direction, and their weight."""
    bodies = sheets(around, draw)
    for body in bodies:
        force = draw.share() * draw.most_force(body, 0, body.upper[1], 1)
        body.settings["Load"] = around.vector({0: around.over_time(around.generator.choice((-1.0, 1.0)) * force)})
    force = draw.share() * min(draw.most_force(body, 0, body.upper[1], 1) for body in bodies)
    around.set_gravity(around.generator.choice((0, 1)) * gravity_of(around, bodies, force, is_free=False))
    return bodies


def between_walls(around, draw):
    """A plate that is pushed up or down; above and below the fluid can flow out."""
    body = draw.plate()
    force = around.generator.choice((-1.0, 1.0)) * draw.share() * draw.most_force(body, 1, 1.0, 2)
    body.settings["Load"] = around.vector({1: around.over_time(force)})
    around.openings["top"]["Sides"] = "top, bottom"
    return [body]


def closed_chamber(around, draw):
    """A plate over a chamber, into which fluid flows."""
    body = draw.plate()
    if around.dim == 3:
        body.settings["Boundaries"]["rim"]["Where"] = "max(max(-x, x-1), max(-z, z-1))"
    filling = around.generator.uniform(*ranges.FILLING)
    region = " - ".join(["0.2", *(f"abs({name} - 0.5)" for name in ("x", "z")[:around.dim - 1])])
    area = 0.4 if around.dim == 2 else 2 * 0.2 ** 2
    flow = f"{2 * filling / (area * around.end)!r}*sin({math.pi / around.end!r}*t)^2"
    around.openings = {"top": {"Sides": "top", "Kind": "outflow"},
                       "inlet": {"Sides": "bottom", "Region": region, "Kind": "inflow", "Velocity": around.vector({1: flow})}}
    return [body]


def column(around, draw):
    """A sheet that carries itself, and more or less than makes it buckle."""
    body = draw.sheet(0.5)
    critical = 7.84 * body.modulus * body.length(0) ** 2 / (12 * body.upper[1] ** 3)
    load = around.generator.uniform(*ranges.COLUMN) * min(critical, ranges.LOAD[1] * body.modulus / body.upper[1])
    body.settings["Load"] = around.vector({0: repr(1e-3 * load), 1: around.over_time(-load)})
    return [body]


KINDS = {"rising and sinking": rising_and_sinking, "falling": falling, "drifting": drifting, "in a stream": in_a_stream,
         "under loads": under_loads, "between walls": between_walls, "closed chamber": closed_chamber, "column": column}
STREAMS = ("drifting", "in a stream")


def drawn(seed, dim, number):
    """The same for the same arguments."""
    generator = random.Random(f"hard {seed} {dim} {number}")
    kind = list(KINDS)[number % len(KINDS)]
    around = Surroundings(generator, dim, kind in STREAMS)
    bodies = KINDS[kind](around, Bodies(around))
    fluid = {"Density": repr(around.density), "Boundaries": around.openings}
    if around.initial_velocity:
        fluid["Initial velocity"] = around.initial_velocity
    scene = {"Title": f"hard scene {number} in {dim}D, {kind}", "Dimension": str(dim),
             "Time": {"End": repr(around.end), "Step": f"1/{around.per_second}"},
             "Domain": {"Lower corner": law_scenes.point([0] * dim), "Upper corner": law_scenes.point(around.size),
                        "Cells": ", ".join(map(str, around.grid))},
             "Fluid": fluid, "Effects": around.effects,
             "Bodies": {f"b{index}": body.section(around.poisson) for index, body in enumerate(bodies)}}
    least = min(bodies, key=lambda body: body.density)
    return HardScene(f"{dim}D {number}: {kind}", scene, {
        "bodies": len(bodies), "least density ratio": least.density / around.density,
        "modulus [Pa]": min(body.modulus for body in bodies), "Poisson": around.poisson, "step [s]": 1 / around.per_second,
        "planes": "on" if around.on_planes else "off",
        "effects": ", ".join(name for name in around.effects if name != "contact")})
