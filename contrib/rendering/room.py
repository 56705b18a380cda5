# SPDX-License-Identifier: LGPL-2.1-or-later
"""The walls around a fluid: in the plane lines, in space a box that one looks into."""
import vtk

from .actors import line_actor, plain_actor
from .colours import WALL

SIDES = {"left": (0, 0), "right": (0, 1), "bottom": (1, 0), "top": (1, 1), "back": (2, 0), "front": (2, 1)}
OPACITY = 0.16


def corners_of(bounds, axis, end, is_flat):
    """Corners of a side, in turn."""
    others = [other for other in range(3) if other != axis and not (is_flat and other == 2)]
    ways = [(0,), (1,)] if len(others) == 1 else [(0, 0), (1, 0), (1, 1), (0, 1)]
    for way in ways:
        place = [bounds[4]] * 3
        place[axis] = bounds[2 * axis + end]
        for other, far in zip(others, way):
            place[other] = bounds[2 * other + far]
        yield place


def side_source(bounds, axis, end, is_flat):
    """A side as one line or one face that looks inwards."""
    points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
    places = list(corners_of(bounds, axis, end, is_flat))
    inwards_as_listed = (end == 0) == (axis != 1)
    for place in places if inwards_as_listed else places[::-1]:
        points.InsertNextPoint(place)
    cells.InsertNextCell(len(places), range(len(places)))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    if is_flat:
        data.SetLines(cells)
    else:
        data.SetPolys(cells)
    source = vtk.vtkTrivialProducer()
    source.SetOutput(data)
    return source


def room_actors(bounds, open_sides, is_flat):
    """Sides of a tank, but for those that are open, and thin edges; of those in space only the far ones are seen."""
    outline = vtk.vtkOutlineSource()
    outline.SetBounds(bounds)
    actors = [line_actor(outline, WALL, 1.2)]
    for name, (axis, end) in SIDES.items():
        if name in open_sides or is_flat and axis == 2:
            continue
        side = side_source(bounds, axis, end, is_flat)
        actor = line_actor(side, WALL, 3) if is_flat else plain_actor(side, WALL)
        if not is_flat:
            actor.GetProperty().LightingOff()
            actor.GetProperty().SetOpacity(OPACITY * (2 if name == "bottom" else 1))
            actor.GetProperty().BackfaceCullingOn()
        actors.append(actor)
    return actors
