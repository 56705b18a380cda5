# SPDX-License-Identifier: LGPL-2.1-or-later
"""The direction of a flow: arrows on a lattice of points, and stream lines. Neither enters a body."""
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from .barrier import Barrier

ARROWS = {"plane": 30, "space": 14}  # along the longest side
LINES = {"plane": 28, "space": 10}  # distances between stream lines along the longest side
LONGEST_LINE = 3  # diagonals of the region
MOST_STEPS = 2000
CLEAR = 1 - 1e-6  # share of fluid around a point that is away from bodies
LENGTH = 1.1  # of the longest arrow, in distances
SLOWEST = 0.03  # share of the largest speed of arrows that are seen


def lattice(bounds, n, plane=None):
    """Points (k, 3) at equal distances, n along the longest side, and that distance. `plane`: (axis, place)."""
    lengths = numpy.array([bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3)])
    distance = lengths.max() / n
    counts = numpy.where(lengths > 1e-9 * lengths.max(), numpy.maximum(1, numpy.rint(lengths / distance)), 1).astype(int)
    sides = [bounds[2 * axis] + (numpy.arange(count) + 0.5) * lengths[axis] / count for axis, count in enumerate(counts)]
    if plane:
        sides[plane[0]] = numpy.array([plane[1]])
    return numpy.stack(numpy.meshgrid(*sides, indexing="ij"), -1).reshape(-1, 3), distance


def points_data(points, **vectors):
    """Points (k, 3), with vectors (k, 3) by name."""
    data, places = vtk.vtkPolyData(), vtk.vtkPoints()
    places.SetData(numpy_to_vtk(points, deep=True))
    data.SetPoints(places)
    for name, values in vectors.items():
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    return data


def velocities(region, points):
    """(velocities (k, 3), whether the points are in the region, and away from bodies)."""
    probe = vtk.vtkProbeFilter()
    probe.SetInputData(points_data(points))
    probe.SetSourceData(region)
    probe.Update()
    found = probe.GetOutput().GetPointData()
    inside = vtk_to_numpy(found.GetArray("vtkValidPointMask")) == 1
    fraction = found.GetArray("fluid_fraction")
    if fraction:
        inside &= vtk_to_numpy(fraction) > CLEAR
    return vtk_to_numpy(found.GetArray("velocity")), inside


def arrows(part, fastest, planes):
    """Begins, vectors and velocities (k, 3) of arrows; the one for the speed `fastest` is as long as they are apart."""
    region, kind = part.region(), "plane" if planes or part.is_flat() else "space"
    found = [numpy.zeros((3, 0, 3))]
    for plane in (planes or [None]) if region.GetNumberOfCells() else []:
        points, distance = lattice(region.GetBounds(), ARROWS[kind], plane)
        values, inside = velocities(region, points)
        lengths = values * (LENGTH * distance / fastest)
        seen = inside & (numpy.linalg.norm(values, axis=1) > SLOWEST * fastest)
        points, lengths, values = points[seen], lengths[seen], values[seen]
        _, ends_inside = velocities(region, points + lengths)
        barrier = Barrier(part.surface)
        free = numpy.array([inside and not barrier.is_crossed(p, p + v) for p, v, inside in zip(points, lengths, ends_inside)], bool)
        found.append(numpy.stack([points, lengths, values])[:, free])
    return numpy.concatenate(found, axis=1)


def traced(region, seeds):
    """Pairs of lines (k, 3) from each seed, along the flow and against it, by the seed's number."""
    tracer = vtk.vtkStreamTracer()
    tracer.SetInputData(region)
    tracer.SetSourceData(points_data(seeds))
    tracer.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "velocity")
    tracer.SetIntegrationDirectionToBoth()
    tracer.SetIntegratorTypeToRungeKutta4()
    tracer.SetIntegrationStepUnit(vtk.vtkStreamTracer.CELL_LENGTH_UNIT)
    tracer.SetInitialIntegrationStep(0.3)
    tracer.SetMaximumPropagation(LONGEST_LINE * region.GetLength())
    tracer.SetMaximumNumberOfSteps(MOST_STEPS)
    tracer.SetComputeVorticity(False)
    tracer.Update()
    found, lines = tracer.GetOutput(), {}
    if found.GetNumberOfCells() == 0:
        return lines
    places = vtk_to_numpy(found.GetPoints().GetData())
    numbers = vtk_to_numpy(found.GetCellData().GetArray("SeedIds"))
    offsets = vtk_to_numpy(found.GetLines().GetOffsetsArray())
    members = vtk_to_numpy(found.GetLines().GetConnectivityArray())
    for seed, begin, end in zip(numbers, offsets[:-1], offsets[1:]):
        lines.setdefault(int(seed), []).append(places[members[begin:end]])
    return lines


class Occupied:
    """Which cells of a lattice have a line in them, and which line."""

    def __init__(self, bounds, width):
        self.low, self.width, self.owner = numpy.array(bounds[0:6:2]), width, {}

    def cells(self, points):
        return list(map(tuple, numpy.floor((points - self.low) / self.width).astype(int)))

    def free_until(self, points, number):
        """How many points come before the first in a cell of another line, or that this line has been in before."""
        passed, last = set(), None
        for k, cell in enumerate(self.cells(points)):
            if self.owner.get(cell, number) != number or cell != last and cell in passed:
                return k
            passed.add(cell)
            last = cell
        return len(points)

    def take(self, points, number):
        for cell in self.cells(points):
            self.owner[cell] = number


def before_barrier(line, barrier):
    for k in range(len(line) - 1):
        if barrier.is_crossed(line[k], line[k + 1]):
            return line[:k + 1]
    return line


def stream_lines(part, planes):
    """Lines (k, 3) along the flow, none of which comes near another."""
    region, kind = part.region(), "plane" if planes or part.is_flat() else "space"
    barrier, result = Barrier(part.surface), []
    if region.GetNumberOfCells() == 0:
        return result
    seeds, distance = lattice(region.GetBounds(), LINES[kind], planes[0] if planes else None)
    for plane in planes[1:]:
        seeds = numpy.concatenate([seeds, lattice(region.GetBounds(), LINES[kind], plane)[0]])
    values, inside = velocities(region, seeds)
    seeds = seeds[inside][numpy.argsort(-numpy.linalg.norm(values[inside], axis=1), kind="stable")]  # the fastest go first
    occupied = Occupied(region.GetBounds(), distance)
    for number, pair in sorted(traced(region, seeds).items()):
        if occupied.free_until(seeds[number:number + 1], number) == 0:
            continue
        halves = [before_barrier(line, barrier) for line in pair]
        halves = [line[:occupied.free_until(line, number)] for line in halves]
        whole = numpy.concatenate([halves[1][:0:-1] if len(halves) > 1 else halves[0][:0], halves[0]])
        length = numpy.linalg.norm(numpy.diff(whole, axis=0), axis=1).sum()
        if length > 2 * distance:
            occupied.take(whole, number)
            result.append(whole)
    return result
