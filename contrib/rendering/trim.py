# SPDX-License-Identifier: LGPL-2.1-or-later
"""A fluid in a plane as far as it reaches: a body thinner than a cell does not hide the rest of the cells that it divides, behind
which there may be no fluid."""
import collections

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from .barrier import Barrier

WET = "is_wet"  # 1 at the corners of cells that are fluid all over


def polygons_of(data):
    """The polygons of a data set, with those points in common that are at one place."""
    faces = vtk.vtkGeometryFilter()
    faces.SetInputData(data)
    clean = vtk.vtkCleanPolyData()
    clean.SetInputConnection(faces.GetOutputPort())
    clean.SetTolerance(1e-7)
    clean.ConvertPolysToLinesOff()
    clean.Update()
    return clean.GetOutput()


def corners_of(data):
    """The numbers of the points of each polygon, in turn."""
    polygons = data.GetPolys()
    ends = vtk_to_numpy(polygons.GetOffsetsArray())
    return numpy.split(vtk_to_numpy(polygons.GetConnectivityArray()), ends[1:-1])


def sides(corners):
    return zip(corners, numpy.roll(corners, -1))


def reached(polygons, wet, is_open):
    """Which points the fluid reaches from those that are wet, along sides of polygons that no surface crosses."""
    neighbours = collections.defaultdict(set)
    for corners in polygons:
        for one, other in sides(corners):
            neighbours[one].add(other)
            neighbours[other].add(one)
    wet = wet.copy()
    ahead = [point for point in neighbours if wet[point]]
    while ahead:
        point = ahead.pop()
        for other in neighbours[point]:
            if not wet[other] and is_open(point, other):
                wet[other] = True
                ahead.append(other)
    return wet


class Beside:
    """Which points near a polygon the fluid reaches."""

    def __init__(self, polygons, wet):
        self.wet, self.at_point = wet, collections.defaultdict(list)
        for corners in polygons:
            for point in corners:
                self.at_point[point].append(corners)

    def reached(self, corners):
        """Of polygons that share a point with this one."""
        near = {point for corner in corners for other in self.at_point[corner] for point in other}
        return [point for point in near if self.wet[point]]


def trimmed(data, surface):
    """The polygons of `data` in a plane up to the `surface` of bodies, where what is behind it is not reached by the fluid. A
    polygon none of whose corners is reached, as in a narrow gap, is drawn unless all of the fluid beside it is on the other side
    of the surface."""
    if surface is None or not data.GetPointData().HasArray(WET) or data.GetNumberOfCells() == 0:
        return data
    data, barrier = polygons_of(data), Barrier(surface)
    points, polygons = vtk_to_numpy(data.GetPoints().GetData()).astype(float), corners_of(data)
    wet = vtk_to_numpy(data.GetPointData().GetArray(WET)) > 1 - 1e-6
    unsure = [corners for corners in polygons if not wet[corners].all()]
    wet = reached(unsure, wet, lambda one, other: not barrier.is_crossed(points[one], points[other]))
    beside = Beside(unsure, wet)
    kept, added = [], []  # polygons; (begin, end, share of the way between them) of new points
    for corners in polygons:
        if wet[corners].all():
            kept.append(corners)
            continue
        if not wet[corners].any():
            near, middle = beside.reached(corners), points[corners].mean(axis=0)
            if not near or not all(barrier.is_crossed(points[point], middle) for point in near):
                kept.append(corners)
            continue
        polygon = []
        for one, other in sides(corners):
            if wet[one]:
                polygon.append(one)
            if wet[one] != wet[other]:
                begin, end = (one, other) if wet[one] else (other, one)
                added.append((begin, end, barrier.share_before(points[begin], points[end])))
                polygon.append(len(points) + len(added) - 1)
        kept.append(polygon)
    return with_points(data, kept, added)


def with_points(data, polygons, added):
    """The polygons on the points of `data` and on new ones between them, with all fields."""
    begin, end = (numpy.array([new[k] for new in added], dtype=int) for k in (0, 1))
    share = numpy.array([new[2] for new in added])

    def extended(array):
        values = vtk_to_numpy(array)
        share_of_value = share.reshape(-1, *[1] * (values.ndim - 1))
        result = numpy_to_vtk(numpy.concatenate([values, (1 - share_of_value) * values[begin] + share_of_value * values[end]]), deep=True)
        result.SetName(array.GetName())
        return result

    result, points, cells = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
    points.SetData(extended(data.GetPoints().GetData()))
    result.SetPoints(points)
    for polygon in polygons:
        cells.InsertNextCell(len(polygon), [int(point) for point in polygon])
    result.SetPolys(cells)
    for k in range(data.GetPointData().GetNumberOfArrays()):
        result.GetPointData().AddArray(extended(data.GetPointData().GetArray(k)))
    return result
