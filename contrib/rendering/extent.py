# SPDX-License-Identifier: LGPL-2.1-or-later
"""What must be known of all frames before the first is drawn: where things are, and how large their values."""
import math

import numpy
import vtk

FAR_OUT = 0.005  # share of particles, at either end, that need not be in the picture
PEAKS = 0.002  # share of a fluid's values, at either end, that may be beyond the scale: vorticity at corners, splashes
MOST_TICKS = 6
STEPS = (1, 2, 2.5, 5, 10)


def nice_step(span):
    """A round number that `span` holds MOST_TICKS - 1 times at most."""
    rough = span / (MOST_TICKS - 1)
    power = 10 ** math.floor(math.log10(rough))
    return next(step * power for step in STEPS if step * power >= rough * (1 - 1e-6))


def rounded(low, high):
    """Limits around both that are multiples of a round step; what is beyond by a hundredth of it counts as rounding."""
    step = nice_step(high - low)
    return math.floor(low / step + 0.01) * step, math.ceil(high / step - 0.01) * step


def ticks(low, high):
    step = nice_step(high - low)
    first, last = math.ceil(low / step - 1e-6), math.floor(high / step + 1e-6)
    return [number * step for number in range(first, last + 1)]


def spread(part, field):
    """Least and largest of a part's values, for a fluid's flow without its peaks; speeds begin at 0."""
    values = part.values(field)
    low, high = float(values.min()), float(values.max())
    if part.is_fluid() and not part.is_carried(field):
        inner = numpy.quantile(values, [PEAKS, 1 - PEAKS])
        if inner[1] - inner[0] > 0.05 * (high - low):  # otherwise what moves is small, no peak
            low, high = map(float, inner)
    if part.data.GetPointData().GetArray(field).GetNumberOfComponents() > 1:
        low = 0.0
    return low, high


class Extent:
    def __init__(self):
        self.bounds = vtk.vtkBoundingBox()
        self.ranges = {}  # by (is_bodies, field)
        self.fields = {"speed"}  # that there are
        self.default = set()  # of the fluid, with which it is coloured
        self.has_particles = False

    def add_domain(self, run):
        box = run.domain()
        if box:
            self.bounds.AddBounds(box)

    def add(self, part, options):
        if part.is_obstacles:  # they may reach out of the domain
            return
        self.bounds.AddBounds(self.bounds_of(part, options))
        self.has_particles |= part.is_particles
        arrays = part.data.GetPointData()
        self.fields |= {arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())}
        fields = {part.colour_field(options.field)}
        if part.is_fluid():
            self.default |= fields
        if part.is_fluid() and (options.vectors or options.streamlines):
            fields.add("velocity")
        for field in fields - {None}:
            low, high = spread(part, field)
            old = self.ranges.get((part.is_bodies, field), (low, high))
            self.ranges[part.is_bodies, field] = (min(low, old[0]), max(high, old[1]))

    def bounds_of(self, part, options):
        if not part.is_particles:
            return part.warped(options.warp).GetBounds()
        inner = numpy.quantile(part.points(), [FAR_OUT, 1 - FAR_OUT], axis=0)
        return inner.T.ravel()

    def limits(self, is_bodies, field, options):
        """Ends of the colour scale of a field."""
        if options.range and (field == options.field if options.field else not is_bodies and field in self.default):
            return options.range
        low, high = self.ranges[is_bodies, field]
        if low < 0 < high and min(-low, high) > 0.05 * max(-low, high):
            low, high = -max(-low, high), max(-low, high)
        if 0 < low < 0.2 * high:
            low = 0.0
        if high - low <= 1e-9 * max(abs(low), abs(high)):
            high = low + (abs(low) or 1) * 1e-3
        return rounded(low, high)

    def corners(self):
        bounds = [0.0] * 6
        self.bounds.GetBounds(bounds)
        return bounds

    def is_flat(self):
        bounds = self.corners()
        return bounds[5] - bounds[4] <= 1e-9 * (bounds[1] - bounds[0])

    def missing(self, options):
        """What is asked for but cannot be shown, in words."""
        bounds = self.corners()
        if not self.ranges:
            return f"no data for the frames '{options.frames}' in '{', '.join(map(str, options.results))}'"
        if options.field and options.field not in {field for _, field in self.ranges}:
            return f"no part has a field '{options.field}'; there are: {', '.join(sorted(self.fields - {None}))}"
        if (options.vectors or options.streamlines) and (False, "velocity") not in self.ranges:
            return "--vectors and --streamlines show how a fluid flows, and there is none"
        if options.surface and not self.has_particles:
            return "--surface is that of a liquid of particles, and there are none"
        if options.slice and self.is_flat():
            return "--slice is for scenes in space"
        for axis, place in options.slice:
            if not bounds[2 * axis] <= place <= bounds[2 * axis + 1]:
                return f"--slice {'xyz'[axis]}={place:g} is outside of the scene, {bounds[2 * axis]:g} to {bounds[2 * axis + 1]:g}"
        return ""
