# SPDX-License-Identifier: LGPL-2.1-or-later
"""Surfaces of bodies and obstacles as what ends lines along a flow, and the fluid."""
import vtk


class Barrier:
    """The lines or triangles that cut the fluid's grid; None: there are none."""

    def __init__(self, surface):
        self.locator = None
        if surface is None or surface.GetNumberOfCells() == 0:
            return
        skin = vtk.vtkGeometryFilter()
        skin.SetInputData(surface)
        skin.Update()
        faces = skin.GetOutput()
        self.length = faces.GetLength()
        if faces.GetNumberOfPolys() == 0:
            faces = ribbon(faces, self.length)
        self.locator = vtk.vtkStaticCellLocator()
        self.locator.SetDataSet(faces)
        self.locator.BuildLocator()

    def share_before(self, begin, end):
        """What share of the straight line between two points is before the barrier; 1: it does not cross it."""
        if self.locator is None:
            return 1.0
        share, piece, place, inner = vtk.reference(0.0), vtk.reference(0), [0.0] * 3, [0.0] * 3
        crosses = self.locator.IntersectWithLine(begin, end, 1e-9 * self.length, share, place, inner, piece)
        return float(share) if crosses else 1.0

    def is_crossed(self, begin, end):
        """By the straight line between two points."""
        return self.share_before(begin, end) < 1


def ribbon(lines, width):
    """Lines in the plane as surfaces across it."""
    extrusion = vtk.vtkLinearExtrusionFilter()
    extrusion.SetInputData(lines)
    extrusion.SetExtrusionTypeToVectorExtrusion()
    extrusion.SetVector(0, 0, width)
    extrusion.CappingOff()
    middle = vtk.vtkTransform()
    middle.Translate(0, 0, -width / 2)
    moved = vtk.vtkTransformPolyDataFilter()
    moved.SetInputConnection(extrusion.GetOutputPort())
    moved.SetTransform(middle)
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(moved.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()
