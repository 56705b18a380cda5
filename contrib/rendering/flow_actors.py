# SPDX-License-Identifier: LGPL-2.1-or-later
"""Arrows and stream lines as things that VTK draws: in the plane and on slices white, else coloured by speed."""
import numpy
import vtk

from .actors import light, line_actor, plain_actor, surface_actor, to_front
from .colours import INK
from .flow import arrows, points_data, stream_lines, velocities

WHITE = (1, 1, 1)
RIM = 1.1  # pixels
TUBE = 1 / 300  # radius of stream lines in space, in lengths of the picture
HEAD = 1 / 70  # length of their arrow heads


def glyphs(shape, begins, vectors, values):
    """A shape that points along x, at every begin, turned along its vector and scaled by it."""
    glyph = vtk.vtkGlyph3D()
    glyph.SetInputData(points_data(begins, arrow=vectors, velocity=values))
    glyph.SetSourceConnection(shape.GetOutputPort())
    glyph.SetInputArrayToProcess(1, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "arrow")
    glyph.SetVectorModeToUseVector()
    glyph.SetScaleModeToScaleByVector()
    glyph.OrientOn()
    glyph.Update()
    return glyph


def arrow_of(is_flat):
    """An arrow of length 1 along x: flat, or round."""
    if not is_flat:
        shape = vtk.vtkArrowSource()
        shape.SetTipResolution(12)
        shape.SetShaftResolution(8)
        shape.SetTipRadius(0.15)
        shape.SetShaftRadius(0.045)
        shape.SetTipLength(0.42)
        return shape
    return polygon([(0, -0.05), (0.55, -0.05), (0.55, -0.2), (1, 0), (0.55, 0.2), (0.55, 0.05), (0, 0.05)])


def head_of(is_flat):
    """The head of an arrow, of length 1, its middle at the origin."""
    if is_flat:
        return polygon([(-0.5, -0.45), (0.5, 0), (-0.5, 0.45)])
    shape = vtk.vtkConeSource()
    shape.SetHeight(1)
    shape.SetRadius(0.35)
    shape.SetResolution(12)
    return shape


def polygon(corners):
    """In the plane; corners in turn."""
    points, faces = vtk.vtkPoints(), vtk.vtkCellArray()
    for corner in corners:
        points.InsertNextPoint(*corner, 0)
    faces.InsertNextCell(len(corners), range(len(corners)))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(faces)
    source = vtk.vtkTrivialProducer()
    source.SetOutput(data)
    return source


def drawn(source, meaning, extent, planes):
    """Faces: in the plane white with a dark rim, in space by speed, but white on slices."""
    if extent.is_flat():
        triangles = vtk.vtkTriangleFilter()
        triangles.SetInputConnection(source.GetOutputPort())
        rim = vtk.vtkFeatureEdges()
        rim.SetInputConnection(source.GetOutputPort())
        rim.ColoringOff()
        return [to_front(light(plain_actor(triangles, WHITE), True), extent, 4),
                to_front(line_actor(rim, INK, RIM), extent, 5)]
    actor = surface_actor(source.GetOutput(), None if planes else meaning, False)
    if planes:
        actor.GetProperty().SetColor(*WHITE)
    return [actor]


def arrow_actors(part, meaning, extent, planes):
    begins, vectors, values = arrows(part, meaning.limits[1], planes)
    if len(begins) == 0:
        return []
    return drawn(glyphs(arrow_of(extent.is_flat()), begins, vectors, values), meaning, extent, planes)


def lines_data(part, lines):
    points = numpy.concatenate(lines)
    data = points_data(points, velocity=velocities(part.region(), points)[0])
    cells, first = vtk.vtkCellArray(), 0
    for line in lines:
        cells.InsertNextCell(len(line), range(first, first + len(line)))
        first += len(line)
    data.SetLines(cells)
    return data


def stream_line_actors(part, meaning, extent, planes):
    lines = stream_lines(part, planes)
    if not lines:
        return []
    data, bounds = vtk.vtkTrivialProducer(), extent.corners()
    data.SetOutput(lines_data(part, lines))
    size = max(bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3))
    middles = numpy.array([line[len(line) // 2] for line in lines])
    along = numpy.array([line[len(line) // 2] - line[len(line) // 2 - 1] for line in lines])
    along *= (HEAD * size / numpy.maximum(numpy.linalg.norm(along, axis=1), 1e-300))[:, None]
    heads = drawn(glyphs(head_of(extent.is_flat()), middles, along, velocities(part.region(), middles)[0]), meaning, extent, planes)
    if extent.is_flat():
        rim, line = line_actor(data, INK, 1.6 + 2 * RIM), line_actor(data, WHITE, 1.6)
        rim.GetProperty().SetOpacity(0.6)
        return [to_front(rim, extent, 2), to_front(line, extent, 3), *heads]
    tube = vtk.vtkTubeFilter()
    tube.SetInputConnection(data.GetOutputPort())
    tube.SetRadius(TUBE * size)
    tube.SetNumberOfSides(8)
    tube.Update()
    return drawn(tube, meaning, extent, planes) + heads
