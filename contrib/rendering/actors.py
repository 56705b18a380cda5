# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies, obstacles, surfaces and particles as things that VTK draws."""
import vtk

from .colours import GREY, INK

FRONT = 1e-3  # in the plane, how far bodies are in front of the fluid, in lengths of the picture
FACETS = {True: (16, 2), False: (12, 9)}  # of discs and balls for particles


def light(actor, is_flat, shine=0.0):
    """Even light in the plane; in space shades, and as much of a highlight."""
    prop = actor.GetProperty()
    prop.SetLighting(not is_flat)
    prop.SetAmbient(0.32)
    prop.SetDiffuse(0.72)
    prop.SetSpecular(shine)
    prop.SetSpecularPower(40)
    return actor


def to_front(actor, extent, layer=1):
    """In the plane, things lie on each other as paper does."""
    bounds = extent.corners()
    if extent.is_flat():
        actor.SetPosition(0, 0, layer * FRONT * max(bounds[1] - bounds[0], bounds[3] - bounds[2]))
    return actor


def surface_actor(data, meaning, is_flat, shine=0.0):
    mapper = vtk.vtkDataSetMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    if meaning:
        meaning.apply(mapper, data)
        mapper.SetInterpolateScalarsBeforeMapping(False)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*GREY)
    return light(actor, is_flat, shine)


def plain_actor(filter_, colour):
    """What a filter gives, in one colour."""
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(filter_.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour)
    return actor


def line_actor(filter_, colour, width):
    actor = plain_actor(filter_, colour)
    actor.GetProperty().SetLineWidth(width)
    actor.GetProperty().LightingOff()
    return actor


def particle_actor(data, diameter, meaning, is_flat, colour=GREY):
    """Balls, in the plane discs."""
    across, along = FACETS[is_flat]
    if is_flat:
        shape = vtk.vtkRegularPolygonSource()
        shape.SetNumberOfSides(across)
    else:
        shape = vtk.vtkSphereSource()
        shape.SetThetaResolution(across)
        shape.SetPhiResolution(along)
    shape.SetRadius(diameter / 2)
    mapper = vtk.vtkGlyph3DMapper()
    mapper.SetInputData(data)
    mapper.SetSourceConnection(shape.GetOutputPort())
    mapper.SetScaling(False)
    mapper.SetOrient(False)
    mapper.ScalarVisibilityOff()
    if meaning:
        meaning.apply(mapper, data)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour)
    return light(actor, is_flat, shine=0.15)


def smooth_skin(data):
    """The surface of cells in space, with normals that turn evenly but for sharp edges."""
    skin = vtk.vtkGeometryFilter()
    skin.SetInputData(data)
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputConnection(skin.GetOutputPort())
    normals.SetFeatureAngle(40)
    normals.Update()
    return normals.GetOutput()


def body_actors(data, meaning, extent):
    """Surface and edges."""
    is_flat = extent.is_flat()
    surface = surface_actor(data if is_flat else smooth_skin(data), meaning, is_flat, shine=0.25)
    return [to_front(surface, extent), to_front(edge_actor(data, is_flat), extent)]


def edge_actor(data, is_flat):
    """The outline of bodies: in 2D their rim, in 3D their sharp edges."""
    skin = vtk.vtkGeometryFilter()
    skin.SetInputData(data)
    edges = vtk.vtkFeatureEdges()
    edges.SetInputConnection(skin.GetOutputPort())
    edges.SetFeatureEdges(not is_flat)
    edges.SetFeatureAngle(40)
    edges.NonManifoldEdgesOff()
    edges.ManifoldEdgesOff()
    edges.ColoringOff()
    return line_actor(edges, INK, 1.5)


def obstacle_actors(data, extent):
    """Surfaces of obstacles, in 2D what they enclose, as far as they are in the domain, and edges."""
    bounds, is_flat = extent.corners(), extent.is_flat()
    faces = vtk.vtkGeometryFilter()
    faces.SetInputData(data)
    if is_flat:
        outline, faces = faces, vtk.vtkContourTriangulator()
        faces.SetInputConnection(outline.GetOutputPort())
    # Side by side: the distance from a whole box is not linear along a large face.
    for axis in range(2 if is_flat else 3):
        for inward in (1, -1):
            side = vtk.vtkPlane()
            side.SetOrigin(*(bounds[0:6:2] if inward == 1 else bounds[1:6:2]))
            side.SetNormal(*(inward * (axis == other) for other in range(3)))
            whole, faces = faces, vtk.vtkClipPolyData()
            faces.SetInputConnection(whole.GetOutputPort())
            faces.SetClipFunction(side)
    actors = [to_front(light(plain_actor(faces, GREY), is_flat), extent)]
    if is_flat:
        rim = vtk.vtkFeatureEdges()
        rim.SetInputConnection(faces.GetOutputPort())
        rim.FeatureEdgesOff()
        rim.ColoringOff()
        actors.append(to_front(line_actor(rim, INK, 1.2), extent, 1.5))
    return actors
