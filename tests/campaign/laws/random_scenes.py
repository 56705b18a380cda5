# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random plane scenes: a block that is free, one or two sheets on the floor, or a bar between walls, in a box of fluid
that is open at the top."""
import dataclasses
import math
import random

import law_energy
import law_outline
import law_scenes
import random_ranges as ranges


@dataclasses.dataclass(frozen=True)
class RandomScene:
    number: int
    scene: dict
    bodies: list  # of `LoadedBody`
    around: law_energy.Surroundings
    figures: dict  # what was drawn, in numbers and words


@dataclasses.dataclass
class Body:
    """One body as it is drawn."""
    name: str
    lower: tuple
    upper: tuple
    cells: tuple
    settings: dict
    capacity: float  # force per volume that strains it by one, or moves it by its length [N/m^3]
    most: float  # force per volume that stretches it by one [N/m^3]
    turn: float = 0.0  # degrees
    push: tuple = (0.0, 0.0)  # direction of a load

    def outline(self):
        middle = [(low + high) / 2 for low, high in zip(self.lower, self.upper)]
        cosine, sine = math.cos(math.radians(self.turn)), math.sin(math.radians(self.turn))

        def position(x, y):
            x, y = x - middle[0], y - middle[1]
            return (middle[0] + cosine * x - sine * y, middle[1] + sine * x + cosine * y)

        return law_outline.of_box(self.name, self.lower, self.upper, self.cells, position)

    def section(self, density, modulus, poisson, load):
        return {"Shape": "box", "Lower corner": law_scenes.point(self.lower), "Rotation": repr(self.turn),
                "Upper corner": law_scenes.point(self.upper), "Cells": ", ".join(map(str, self.cells)),
                "Density": repr(density), "Young's modulus": repr(modulus), "Poisson's ratio": repr(poisson),
                "Load": "; ".join(map(repr, load)), **self.settings}


def logarithmic(generator, bounds):
    return math.exp(generator.uniform(*map(math.log, bounds)))


class Drawing:
    """One scene after the other from a generator; what is common to all kinds of bodies is drawn first."""

    def __init__(self, seed, number):
        self.generator = random.Random(f"{seed} {number}")
        self.number = number
        self.kind = ranges.BODIES[number % len(ranges.BODIES)]
        self.grid = [self.generator.randint(*ranges.GRID) for _ in range(2)]
        self.modulus = logarithmic(self.generator, ranges.MODULUS)
        self.density = ranges.FLUID_DENSITY * logarithmic(self.generator, ranges.DENSITY_RATIO)
        self.poisson = self.generator.uniform(*ranges.POISSON)
        self.thickness = logarithmic(self.generator, ranges.THICKNESS)
        self.per_second = self.generator.choice(ranges.STEPS)
        self.end = self.generator.randint(*ranges.STEPS_OF_A_RUN) / self.per_second
        self.on_planes = self.chance(ranges.ON_PLANES)
        self.contact = self.chance(ranges.WITH_CONTACT)
        self.damping = logarithmic(self.generator, ranges.DAMPING) if self.chance(ranges.WITH_DAMPING) else 0.0

    def chance(self, share):
        return self.generator.random() < share

    def place(self, value, axis):
        """Where a face begins [m]."""
        return round(value * self.grid[axis]) / self.grid[axis] if self.on_planes else value

    def bodies(self):
        if self.kind == "free block":
            return [self.block()]
        if self.kind == "bar between walls":
            return [self.bar()]
        return self.sheets()

    def block(self):
        size = [self.generator.uniform(*ranges.BLOCK_SIZE) for _ in range(2)]
        lower = [self.place(self.generator.uniform(0.45, 0.55) - length / 2, axis) for axis, length in enumerate(size)]
        cells = tuple(self.generator.randint(*ranges.BLOCK_CELLS) for _ in range(2))
        turned = not self.on_planes and self.chance(ranges.TURNED)
        return Body("block", tuple(lower), tuple(low + length for low, length in zip(lower, size)), cells, {},
                    self.modulus / size[1], self.modulus / size[1], self.generator.uniform(-45, 45) if turned else 0.0)

    def sheets(self):
        """They stand on the floor; one more cell of each is held below it."""
        count = 2 if self.kind == "two sheets" else 1
        first = self.generator.uniform(*ranges.SHEETS_AT)
        apart = self.generator.uniform(*ranges.SHEETS_APART) if self.contact else ranges.FAR_APART
        towards = self.contact and self.chance(0.7)
        return [self.sheet("sheet" if count == 1 else ("left", "right")[which], self.place(first + which * apart, 0),
                           -1.0 if towards and which else 1.0) for which in range(count)]

    def sheet(self, name, at, sign):
        height, along = self.generator.uniform(*ranges.SHEET_LENGTH), self.generator.randint(*ranges.CELLS_ALONG)
        wide = self.thickness / self.grid[0]
        capacity = self.capacity(2 / 3 * self.modulus * wide ** 2 / height ** 3, wide, height)
        clamp = {"Boundaries": {"foot": {"Kind": "clamp", "Where": "-y"}}}
        return Body(name, (at, -height / along), (at + wide, height), (1, along + 1), clamp, capacity,
                    self.modulus / height, push=(sign, 0.0))

    def bar(self):
        """One more cell of it is held behind each wall."""
        along = self.generator.randint(*ranges.CELLS_ALONG)
        at = self.place(self.generator.uniform(*ranges.BAR_HEIGHT), 1)
        wide = self.thickness / self.grid[1]
        capacity = self.capacity(32 * self.modulus * wide ** 2, wide, 1.0)
        clamp = {"Boundaries": {"ends": {"Kind": "clamp", "Where": "max(-x, x-1)"}}}
        return Body("bar", (-1 / along, at), (1 + 1 / along, at + wide), (along + 2, 1), clamp, capacity, self.modulus,
                    push=(0.0, self.generator.choice((-1.0, 1.0))))

    def capacity(self, bending, wide, length):
        """Of a sheet or bar: what holds it if it bends by its length [N/m^3], and what takes it so far, with the fluid
        around it, within the run."""
        mass = self.density * wide + ranges.FLUID_DENSITY * length
        return bending + 2 * length * mass / (wide * self.end ** 2)

    def force(self, bodies):
        """Per volume, on the weakest of the bodies [N/m^3]."""
        share = logarithmic(self.generator, ranges.LOAD)
        if self.kind == "two sheets" and not self.contact:
            share *= ranges.LESS_LOAD
        return min(min(share * body.capacity, ranges.LOAD[1] * body.most) for body in bodies)

    def gravity(self, force):
        """With which the weight of a body, or of what it displaces, is this force per volume."""
        result = min(ranges.MOST_GRAVITY, force / max(self.density, ranges.FLUID_DENSITY))
        return min(result, ranges.MOST_WAY / self.end ** 2) if self.kind == "free block" else result

    def draw(self):
        bodies = self.bodies()
        force = self.force(bodies)
        loads = "gravity" if self.kind == "free block" else self.generator.choice(ranges.LOADS)
        force /= 2 if loads == "gravity and load" else 1
        around = law_energy.Surroundings(ranges.FLUID_DENSITY, self.gravity(force) if "gravity" in loads else 0.0, 1.0)
        pushed = force if "load" in loads else 0.0
        loaded = [law_energy.LoadedBody(body.name, self.density, body.outline(),
                                        tuple(pushed * part for part in body.push)) for body in bodies]
        return RandomScene(self.number, self.scene(bodies, loaded, around), loaded, around, {
            "density ratio": self.density / ranges.FLUID_DENSITY, "modulus [Pa]": self.modulus,
            **({} if self.kind == "free block" else {"thickness [cells]": self.thickness}),
            "step [s]": 1 / self.per_second, "planes": "on" if self.on_planes else "off",
            "damping": "with" if self.damping else "without", "contact": "with" if self.contact else "without",
            "loads": loads})

    def scene(self, bodies, loaded, around):
        grid = {"Lower corner": "0, 0", "Upper corner": "1, 1", "Cells": ", ".join(map(str, self.grid))}
        scene = {"Title": f"random scene {self.number}, {self.kind}", "Dimension": "2",
                 "Time": {"End": repr(self.end), "Step": f"1/{self.per_second}"}, "Domain": grid,
                 "Fluid": {"Density": repr(ranges.FLUID_DENSITY)}, "Effects": {},
                 "Bodies": {body.name: body.section(self.density, self.modulus, self.poisson, this.load)
                            for body, this in zip(bodies, loaded)}}
        effects = {"Effects/contact": {}} if self.contact else {}
        if self.damping:
            effects["Effects/damping"] = {"Stiffness coefficient": repr(self.damping)}
        # Without an opening below a bar would close a chamber, in which a uniform load moves nothing.
        opening = around.settings("top, bottom" if self.kind == "bar between walls" else "top")
        probes = {path: section for body in loaded for path, section in body.outline.settings().items()}
        return law_scenes.with_settings(scene, opening, effects, probes)


def drawn(seed, number):
    """The same for the same seed and number."""
    return Drawing(seed, number).draw()
