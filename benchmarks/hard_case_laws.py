# SPDX-License-Identifier: LGPL-2.1-or-later
"""What must be seen in the scenes of prm/hard: a number for each, and the motion of which damping or mean is compared with
that in shorter steps."""
import math
import re
from dataclasses import dataclass
from typing import Callable

import numpy

from study.columns import column


@dataclass
class Law:
    """A number of a run, {column: values}, and what it should be."""
    what: str
    value: Callable
    wanted: float
    allowed: float  # absolute
    early: bool = False  # it holds in the first few steps, too

    def keeps(self, value):
        return abs(value - self.wanted) <= self.allowed


@dataclass
class Hard:
    """A scene: its law, the column of a displacement, and from when on this swings freely about a place of rest, or, where it
    does not, from when on its mean is taken [s]."""
    law: Law
    column: str
    swings: float = math.nan
    mean: float = math.nan
    short: float = 0.2  # end of the run with steps of 1/30 s that is made as a test, a quarter for 1/240 [s]; where steps are dear
    # a little less than a whole number of them, since what is left over would be a step, too
    scheme: str = "simultaneous"  # that must be stable; of 'particle' steps are frames, and no others are compared with them
    above: float = 1e-3  # share of the potential energy by which that of particles may rise above the start
    further: tuple = ()  # laws

    def laws(self):
        if self.scheme != "particle":
            return [self.law, *self.further]
        return [self.law, Law("fluid particles lost", lost("Fluid particles"), 0, 0, True),
                Law("energy above the start / potential energy", gained_energy, 0, self.above, True)]


def peak(times, values):
    """Time and value of the extreme of the parabola through three values, be they unevenly apart."""
    left, right = numpy.diff(values) / numpy.diff(times)
    bend = (right - left) / (times[2] - times[0])
    slope = left + bend * (times[1] - times[0])
    shift = -slope / (2 * bend) if bend != 0 else 0.0
    return times[1] + shift, values[1] + slope * shift / 2


def extremes(times, values, least):
    """Times and values of the extremes, by parabolas through three values each; what goes back by less than `least` is none."""
    found, turning = [], 0  # index of the extreme since the last one that was found
    rising = None
    for k in range(1, len(values)):
        if rising is None:
            rising = values[k] > values[0] if abs(values[k] - values[0]) > least else None
        further = values[k] > values[turning] if rising or rising is None else values[k] < values[turning]
        if further:
            turning = k
        elif rising is not None and abs(values[k] - values[turning]) > least:
            found.append(peak(times[turning - 1:turning + 2], values[turning - 1:turning + 2]))
            rising, turning = not rising, k
    return numpy.array(found).reshape(-1, 2).T


def swing(run, name, begin, least=0.05):
    """Angular frequency [1/s] and damping ratio of a free swing, by the logarithmic decrement of the differences between
    extremes that follow each other, which knows nothing of the place of rest. Differences below a share `least` of the
    whole range are left out."""
    times, values = run["Time"], column(run, name)
    times, values = times[times >= begin], values[times >= begin]
    if len(times) < 3:
        return math.nan, math.nan
    at, peaks = extremes(times, values, least * (values.max() - values.min()))
    ranges = numpy.abs(numpy.diff(peaks))
    if len(ranges) < 2:
        return math.nan, math.nan
    decrement = -numpy.polyfit(range(len(ranges)), numpy.log(ranges), 1)[0] / math.pi
    ratio = decrement / math.sqrt(1 + decrement ** 2)
    return math.pi * len(ranges) / (at[-1] - at[0]) / math.sqrt(1 - ratio ** 2), ratio


def mean(run, name, begin):
    """Over time, from `begin` on."""
    late = run["Time"] >= begin
    times, values = run["Time"][late], column(run, name)[late]
    return float(numpy.trapz(values, times) / (times[-1] - times[0])) if len(times) > 1 else math.nan


def last(name):
    return lambda run: float(column(run, name)[-1])


def least(name):
    return lambda run: float(column(run, name).min())


def largest(name):
    return lambda run: float(numpy.abs(column(run, name)).max())


def gained(name):
    return lambda run: float(column(run, name)[-1] - column(run, name)[0])


def changed(name):
    return lambda run: float(numpy.abs(column(run, name) - column(run, name)[0]).max())


def ratio_over_theory(name, eta, begin=0.0):
    """Damping ratio of a swing over eta omega/2, which is exact for small ones of any elastic body in a fluid without
    friction."""
    def value(run):
        omega, ratio = swing(run, name, begin)
        return ratio / (eta * omega / 2)
    return value


def beam_frequency(thickness, length, density, modulus, poissons_ratio):
    """Of a clamped beam in plane strain, in vacuum [1/s]."""
    stiffness = modulus / (1 - poissons_ratio ** 2) * thickness ** 3 / 12
    return 1.8751041 ** 2 * math.sqrt(stiffness / (density * thickness)) / length ** 2


def ring_pressure(inner):
    """Of a ring with radii 1 and 1.1 m at rest, mu = 1e5 Pa, blown up to this inner radius [Pa]."""
    grown = inner ** 2 - 1
    r = numpy.linspace(inner, math.sqrt(1.1 ** 2 + grown), 1001)
    stretch = r / numpy.sqrt(r ** 2 - grown)
    return 1e5 * float(numpy.trapz((stretch ** 2 - stretch ** -2) / r, r))


def ring_against_theory(run):
    """The pressure in the ring over that for its radius, means of the last half second."""
    return mean(run, "water pressure", 2.5) / ring_pressure(1 + mean(run, "lower displacement x", 2.5))


def ball_against_theory(run):
    """The pressure in an octant of a ball, from radii 1 and 1.1 m, over that for its volume: mu = 1e5 Pa, means of the last 0.2 s."""
    inner = (6 * mean(run, "cavity volume", 2.8) / math.pi) ** (1 / 3)
    outer = (1.1 ** 3 - 1 + inner ** 3) ** (1 / 3)
    stretched = [1 / stretch + 1 / (4 * stretch ** 4) for stretch in (outer / 1.1, inner)]
    return mean(run, "water pressure", 2.8) / (2e5 * (stretched[0] - stretched[1]))


def bow_over_theory(thickness):
    """The bow of a column of 0.7 m, shortened by 0.03 m, over that of one that is compressed until it buckles and then bends
    without a further change of its length."""
    critical = math.pi ** 2 * thickness ** 2 / (3 * 0.7)
    bow = 2 / math.pi * math.sqrt(0.7 * (0.03 - critical))
    return lambda run: float(column(run, "middle displacement x")[-1] / bow)


def mirrored(run):
    """The largest sum of displacements of two bodies that mirror each other, over the largest of them."""
    left, right = (column(run, f"{name}_centre displacement x") for name in ("left", "right"))
    return float(numpy.abs(left + right).max() / numpy.abs(left).max())


def carried(name, begin):
    """The mean force of the floor on a body of twice the water's density, over its weight in water, g = 9.81 m/s^2."""
    return lambda run: mean(run, f"contact force {name} y", begin) / (1000 * 9.81 * column(run, f"volume {name}")[0])


def created(run):
    """Energy that nobody has put in, of the largest energy."""
    return float(column(run, "energy created").max() / column(run, "energy").max())


def narrowest(run):
    """The least gap over that at the start, where nothing touches: the distance at which contact begins."""
    gaps = column(run, "least gap")
    return float(gaps.min() / gaps[0])


def kept_energy(run):
    """Of all that moves and is strained, at the end over that at the start."""
    names = ("Fluid kinetic energy", "solid kinetic energy", "solid elastic energy")
    return float(sum(column(run, name)[-1] for name in names) / sum(column(run, name)[0] for name in names))


def lost(name):
    return lambda run: float(column(run, name)[0] - column(run, name).min())


def gained_energy(run):
    """Of fluid and bodies, the most that there was above the start, over their potential energy then (in a full box that of
    what bodies are heavier or lighter than the fluid in their place)."""
    total = sum(column(run, name) for name in ("Kinetic energy of fluid", "Kinetic energy of bodies", "Potential energy",
                                               "Elastic energy"))
    return float((total - total[0]).max() / abs(column(run, "Potential energy")[0]))


def fallen(density, added, until):
    """The way of a body, `density` times as dense as the fluid, over that with the added mass [of the displaced fluid's], from
    rest; both at this time."""
    def value(run):
        height = column(run, next(name for name in run if re.match(r"Centre of \w+ y$", name)))
        way = numpy.interp(until, run["Time"], height) - height[0]
        return float(way / (-9.81 * (density - 1) / (density + added) * until ** 2 / 2))
    return value


def added_in_box(radius, width):
    """Added mass of a cylinder in the middle of a square box, over that of the displaced fluid: image dipoles behind the walls move
    as fast as 1.094 times its share of the box."""
    return 1 + 2 * 1.094 * math.pi * (radius / width) ** 2


def added_in_cube(radius, width):
    """The same of a ball in a cube."""
    return 0.5 + 1.5 * 1.156 * 4 / 3 * math.pi * (radius / width) ** 3


def submerged_part(depth, dimension):
    """Of a cylinder or ball of radius 1 below a plane that is `depth` above its centre."""
    if dimension == 3:
        return (1 + depth) ** 2 * (2 - depth) / 4
    angle = math.acos(-depth)
    return (angle - math.sin(angle) * math.cos(angle)) / math.pi


def floating_depth(density, dimension):
    """Of the centre below the level [radii], by Archimedes; `density` times that of the fluid."""
    low, high = -1.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if submerged_part(middle, dimension) < density else (low, middle)
    return low


def off_its_depth(density, radius, spacing, *widths, begin):
    """How much deeper than by Archimedes a cylinder or ball floats in a tank with these widths, in the mean from `begin` on
    [radii]."""
    dimension = len(widths) + 1
    body = math.pi * radius ** 2 if dimension == 2 else 4 / 3 * math.pi * radius ** 3

    def value(run):
        height = next(name for name in run if re.match(r"Centre of \w+ y$", name))
        fluid = column(run, "Fluid particles")[-1] * spacing ** dimension
        level = (fluid + density * body) / math.prod(widths)
        return (level - mean(run, height, begin)) / radius - floating_depth(density, dimension)
    return value


def bend_over_theory(load, length, thickness, modulus, begin):
    """The mean deflection of the middle of a plate that is clamped at both ends, over that by bending and shear (with the shear
    coefficient 5/6) under a load [Pa]; Poisson's ratio is zero."""
    bending = load * length ** 4 / (384 * modulus * thickness ** 3 / 12)
    shear = load * length ** 2 / (8 * 5 / 6 * modulus / 2 * thickness)
    return lambda run: -mean(run, "middle displacement y", begin) / (bending + shear)


GAP = "least gap / distance where contact begins"
FILLED = "gain of the chamber"
RATIO = "damping ratio / (eta omega/2)"

ADDED_MASS = "way / that with the added mass"
FLOATS = "depth beyond that of Archimedes [radii]"
POURED = 9.81 * (1000 * 0.2 + 100 * 0.08)  # water 0.2 m deep, and the plate's own weight [Pa]

SCENES = {
    "light_sheet": Hard(Law(RATIO, ratio_over_theory("tip displacement x", 3.3e-3), 1, 0.1), "tip displacement x", swings=0),
    "light_sheet_3d": Hard(Law(RATIO, ratio_over_theory("tip displacement x", 5e-3), 1, 0.1), "tip displacement x", swings=0, short=0.1),
    "heavy_sheet": Hard(Law("frequency / beam's", lambda run: swing(run, "tip displacement x", 0)[0] /
                            beam_frequency(0.02, 0.6, 1200, 5e7, 0.3), 1, 0.03), "tip displacement x", swings=0),
    "soft_block": Hard(Law("lean of the top [m]", last("top displacement x"), 0.115, 0.015), "top displacement x", mean=2),
    "stiff_sheet": Hard(Law("bend of the tip [m]", lambda run: mean(run, "tip displacement x", 1.5), 3.8e-3, 2e-4),
                        "tip displacement x", mean=0, short=0.1),
    "incompressible_plug": Hard(Law(RATIO, ratio_over_theory("middle displacement x", 0.01, 0.4), 1, 0.1),
                                "middle displacement x", swings=0.4),
    "incompressible_plug_3d": Hard(Law(RATIO, ratio_over_theory("middle displacement x", 5e-3, 0.2), 1, 0.15),
                                   "middle displacement x", swings=0.2, short=0.1),
    "thin_sheet": Hard(Law("damping ratio", lambda run: swing(run, "tip displacement x", 0)[1], 0, 2e-3),
                       "tip displacement x", swings=0),
    "thin_membrane": Hard(Law(FILLED + " [m^2]", gained("inside volume"), 0.03, 3e-6), "middle displacement y", mean=1),
    "thin_membrane_3d": Hard(Law(FILLED + " [m^3]", gained("inside volume"), 0.024, 1e-5), "middle displacement y", mean=0.5, short=0.0666),
    "sheets_on_planes": Hard(Law("change of a closed chamber [m^2]", changed("between volume"), 0, 1e-8, True),
                             "middle displacement x", mean=0.5,
                             further=(Law("of another", changed("beyond volume"), 0, 1e-8, True),
                                      Law(FILLED, gained("inside volume"), 0.025, 3e-6))),
    "sheet_on_planes_3d": Hard(Law(FILLED + " [m^3]", gained("inside volume"), 0.025, 3e-6), "middle displacement x", mean=0.5, short=0.1),
    "inflated_ring": Hard(Law("pressure / theory", ring_against_theory, 1, 0.08), "lower displacement x", mean=2.6),
    "inflated_sphere": Hard(Law("pressure / theory", ball_against_theory, 1, 0.05), "inner displacement x", mean=2.8, short=0.0666),
    "body_against_wall": Hard(Law("force of the floor / weight in water", carried("disc", 0.7), 1, 0.1),
                              "centre displacement y", mean=0.7, short=0.3),
    "body_against_wall_3d": Hard(Law("force of the floor / weight in water", carried("ball", 0.5), 1, 0.15),
                                 "centre displacement y", mean=0.5, short=0.0666),
    "body_against_body": Hard(Law("departure from mirror images", mirrored, 0, 0.05, True), "left_centre displacement x",
                              mean=0.1, short=0.1666),
    "body_against_body_3d": Hard(Law("departure from mirror images", mirrored, 0, 0.05, True), "left_centre displacement x",
                                 mean=0.1, short=0.0333),
    "folding_sheet": Hard(Law(GAP, narrowest, 0.5, 0.4999), "fold displacement x", mean=1, short=0.5),
    "folding_sheet_3d": Hard(Law(GAP, narrowest, 0.5, 0.4999), "fold displacement x", mean=1, short=0.0666),
    "sheets_close_pocket": Hard(Law("largest kinetic energy of the water [J]", largest("Fluid kinetic energy"), 0.4, 0.2),
                                "tip displacement x", mean=0.5),
    "folding_sheet_pocket": Hard(Law(GAP, narrowest, 0.5, 0.4999), "fold displacement x", mean=1, short=0.5),
    "body_drifts_through": Hard(Law("way of the disc [m]", gained("centre displacement x"), 2.6, 0.01),
                                "centre displacement x", mean=0),
    "body_drifts_through_3d": Hard(Law("way of the ball [m]", gained("centre displacement x"), 1.8, 0.01),
                                   "centre displacement x", mean=0, short=0.1),
    "two_hundred_bodies": Hard(Law("energy created / largest", created, 0, 0.02, True), "", short=0.034),
    "fifty_bodies_3d": Hard(Law("energy created / largest", created, 0, 0.02, True), "", short=0.034),
    "no_gravity": Hard(Law("energy at the end / at the start", kept_energy, 0.9, 0.1), "centre displacement x", mean=0),
    "hundred_g": Hard(Law("deflection [m]", last("middle displacement y"), -0.02083, 3e-4), "middle displacement y", mean=0.4),
    "hundred_g_3d": Hard(Law("deflection [m]", last("middle displacement y"), -0.0030, 3e-4), "middle displacement y", mean=0.25, short=0.0666),
    "impulsive_start": Hard(Law("mean bend in the end [m]", lambda run: mean(run, "tip displacement x", 1), 0.0323, 2e-3),
                            "tip displacement x", mean=0, short=0.1),
    "impulsive_start_3d": Hard(Law("mean bend in the end [m]", lambda run: mean(run, "tip displacement x", 0.3), 0.025, 5e-3),
                               "tip displacement x", mean=0.3, short=0.0666),
    "load_switched_off": Hard(Law(RATIO, ratio_over_theory("tip displacement x", 3.3e-3, 0.5), 1, 0.1), "tip displacement x",
                              swings=0.5, short=0.7),
    "at_rest": Hard(Law("speed at the end [m/s]", last("top velocity y"), 0, 1e-9), "top displacement y", mean=10, short=1),
    "arch_snaps": Hard(Law("lowest place of the middle [m]", least("middle displacement y"), -0.2, 0.03), "middle displacement y",
                       mean=0),
    "arch_snaps_3d": Hard(Law("lowest place of the middle [m]", least("middle displacement y"), -0.2, 0.03), "middle displacement y",
                          mean=0, short=0.1),
    "column_buckles": Hard(Law("bow / theory", bow_over_theory(0.02), 1, 0.05), "middle displacement x", mean=1.1),
    "column_buckles_3d": Hard(Law("bow / theory", bow_over_theory(0.03), 1, 0.05), "middle displacement x", mean=1.1, short=0.1),
    "viscous_flag": Hard(Law("tip [m]", last("tip displacement y"), 0.82e-3, 0.2e-3), "tip displacement y", mean=2, short=0.1),
    "poured_on_plate_particles": Hard(Law("deflection / theory", bend_over_theory(POURED, 0.4, 0.08, 5e5, 1), 1, 0.1), "",
                                      scheme="particle"),
    "poured_on_plate_particles_3d": Hard(Law("deflection / theory", bend_over_theory(POURED, 0.4, 0.08, 5e5, 0.35), 1, 0.2), "",
                                         short=0.0666, scheme="particle"),
    "poured_on_soft_body_particles": Hard(Law(FLOATS, off_its_depth(0.5, 0.01, 0.0025, 0.075, begin=0.5), 0, 0.15), "",
                                          scheme="particle"),
    "soft_body_dropped_particles": Hard(Law(FLOATS, off_its_depth(0.5, 0.025, 0.005, 0.2, begin=0.6), 0, 0.1), "", scheme="particle"),
    "stiff_body_dropped_particles": Hard(Law(FLOATS, off_its_depth(0.5, 0.1, 0.02, 0.8, begin=1), 0, 0.1), "", scheme="particle"),
    "stiff_body_dropped_particles_3d": Hard(Law(FLOATS, off_its_depth(0.5, 0.08, 0.02, 0.28, 0.28, begin=0.5), 0, 0.15), "",
                                            scheme="particle", short=0.1),
    "heavy_body_dropped_particles": Hard(Law("way / free fall", fallen(1e3, 0, 0.2), 1, 0.05), "", scheme="particle"),
    "light_body_rises_particles": Hard(Law(FLOATS, off_its_depth(0.1, 0.1, 0.02, 0.8, begin=1), 0, 0.1), "", scheme="particle"),
    "light_body_full_box_particles": Hard(Law(ADDED_MASS, fallen(0.1, added_in_box(0.1, 0.6), 2 / 15), 1, 0.1), "",
                                          scheme="particle", above=0.05, short=0.1),
    "heavy_body_full_box_particles": Hard(Law(ADDED_MASS, fallen(1e3, added_in_box(0.1, 0.6), 2 / 15), 1, 0.05), "",
                                          scheme="particle"),
    "heavy_body_full_box_particles_3d": Hard(Law(ADDED_MASS, fallen(1e3, added_in_cube(0.07, 0.28), 0.1), 1, 0.05), "",
                                             short=0.0666, scheme="particle"),
    "soft_body_full_box_particles": Hard(Law(ADDED_MASS, fallen(1.5, added_in_box(0.025, 0.15), 2 / 15), 1, 0.1), "",
                                         scheme="particle"),
}
