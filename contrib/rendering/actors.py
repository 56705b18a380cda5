# SPDX-License-Identifier: LGPL-2.1-or-later
"""What stands in a picture: bodies, obstacles and fluid as things that VTK draws."""
import vtk

VIRIDIS = ["#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725"]
WATER = ["#f7fbff", "#d0e1f2", "#94c4df", "#4a98c9", "#1764ab", "#08306b"]
SMOKE = ["#ffffff", "#c9c9c9", "#8c8c8c", "#4d4d4d", "#1a1a1a"]
HEAT = ["#fff7ec", "#fdd49e", "#fc8d59", "#d7301f", "#7f0000"]
SIGNED = ["#2166ac", "#92c5de", "#f7f7f7", "#f4a582", "#b2182b"]
INK = (0.12, 0.12, 0.15)
GREY = (0.55, 0.55, 0.57)


def colour_table(field, is_bodies, limits):
    if limits[0] < 0 < limits[1]:
        return SIGNED
    return {"smoke": SMOKE, "temperature": HEAT}.get(field, VIRIDIS if is_bodies else WATER)


def transfer_function(table, limits):
    low, high = limits
    transfer = vtk.vtkColorTransferFunction()
    for number, colour in enumerate(table):
        share = number / (len(table) - 1)
        rgb = [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]
        transfer.AddRGBPoint(low + share * (high - low), *rgb)
    return transfer


def surface_actor(data, field, transfer, is_flat):
    mapper = vtk.vtkDataSetMapper()
    mapper.SetInputData(data)
    if field:
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(field)
        if data.GetPointData().GetArray(field).GetNumberOfComponents() > 1:
            transfer.SetVectorModeToMagnitude()
        mapper.SetLookupTable(transfer)
        mapper.UseLookupTableScalarRangeOn()
        mapper.SetInterpolateScalarsBeforeMapping(False)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetLighting(not is_flat)
    actor.GetProperty().SetAmbient(0.4)
    actor.GetProperty().SetDiffuse(0.65)
    return actor


def plain_actor(filter_, colour):
    """What a filter gives, in one colour."""
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(filter_.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour)
    return actor


def particle_actor(part, field, transfer):
    """Balls, in the plane discs, as wide as particles are apart."""
    if part.is_flat():
        shape = vtk.vtkRegularPolygonSource()
        shape.SetNumberOfSides(12)
        shape.SetRadius(part.diameter / 2)
    else:
        shape = vtk.vtkSphereSource()
        shape.SetThetaResolution(10)
        shape.SetPhiResolution(8)
        shape.SetRadius(part.diameter / 2)
    mapper = vtk.vtkGlyph3DMapper()
    mapper.SetInputData(part.data)
    mapper.SetSourceConnection(shape.GetOutputPort())
    mapper.SetScaling(False)
    mapper.SetOrient(False)
    mapper.SetScalarVisibility(bool(field))
    if field:
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(field)
        if part.data.GetPointData().GetArray(field).GetNumberOfComponents() > 1:
            transfer.SetVectorModeToMagnitude()
        mapper.SetLookupTable(transfer)
        mapper.UseLookupTableScalarRangeOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*GREY)
    actor.GetProperty().SetLighting(not part.is_flat())
    actor.GetProperty().SetAmbient(0.35)
    actor.GetProperty().SetDiffuse(0.7)
    return actor


def edge_actor(data, flat):
    """The outline of bodies: in 2D their rim, in 3D their sharp edges."""
    skin = vtk.vtkGeometryFilter()
    skin.SetInputData(data)
    edges = vtk.vtkFeatureEdges()
    edges.SetInputConnection(skin.GetOutputPort())
    edges.SetFeatureEdges(not flat)
    edges.SetFeatureAngle(40)
    edges.NonManifoldEdgesOff()
    edges.ManifoldEdgesOff()
    edges.ColoringOff()
    actor = plain_actor(edges, INK)
    actor.GetProperty().SetLineWidth(1.5)
    actor.GetProperty().LightingOff()
    return actor


def obstacle_actor(data, bounds, is_flat):
    """Surfaces of obstacles, in 2D what they enclose, as far as they are in the domain."""
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
    actor = plain_actor(faces, GREY)
    actor.GetProperty().SetLighting(not is_flat)
    actor.GetProperty().SetAmbient(0.4)
    actor.GetProperty().SetDiffuse(0.65)
    if is_flat:  # in front of the fluid
        actor.SetPosition(0, 0, 1e-3 * (bounds[1] - bounds[0]))
    return actor


def cloud(data, field, table, limits):
    """A scalar in space as translucent volume, denser where it is higher."""
    bounds = data.GetBounds()
    lengths = [bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3)]
    spacing = max(lengths) / 128
    resample = vtk.vtkResampleToImage()
    resample.SetInputDataObject(data)
    resample.SetSamplingDimensions(*(max(2, round(length / spacing)) for length in lengths))
    resample.Update()
    image = resample.GetOutput()
    image.GetPointData().SetActiveScalars(field)
    mapper = vtk.vtkOpenGLGPUVolumeRayCastMapper()
    mapper.SetInputData(image)
    opacity = vtk.vtkPiecewiseFunction()
    for share, value in ((0, 0), (0.03, 0), (1, 0.2)):
        opacity.AddPoint(limits[0] + share * (limits[1] - limits[0]), value)
    # Thin clouds are light because they are translucent: their colour need not be light too.
    dark = [SMOKE[-1], SMOKE[-1]] if table is SMOKE else table[1:]
    volume = vtk.vtkVolume()
    volume.SetMapper(mapper)
    volume.GetProperty().SetColor(transfer_function(dark, limits))
    volume.GetProperty().SetScalarOpacity(opacity)
    volume.GetProperty().SetScalarOpacityUnitDistance(max(lengths) / 40)
    volume.GetProperty().SetInterpolationTypeToLinear()
    return volume


def box_actor(bounds):
    source = vtk.vtkOutlineSource()
    source.SetBounds(bounds)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.55, 0.55, 0.6)
    actor.GetProperty().LightingOff()
    return actor


def middle_slice(data):
    plane = vtk.vtkPlane()
    plane.SetOrigin(data.GetCenter())
    plane.SetNormal(0, 0, 1)
    cut = vtk.vtkCutter()
    cut.SetInputData(data)
    cut.SetCutFunction(plane)
    cut.Update()
    return cut.GetOutput()


def add_particles(renderer, part, extent, options):
    """The same for particles."""
    field = part.colour_field(options.field)
    transfer = None
    if field:
        limits = extent.range_of(part, field, options)
        transfer = transfer_function(colour_table(field, part.is_bodies, limits), limits)
    renderer.AddActor(particle_actor(part, field, transfer))
    return field and (part.is_bodies, field, transfer)


def add_part(renderer, part, extent, options):
    """Draw a part. Returns what the colours mean, (is_bodies, field, transfer), or None."""
    if part.is_particles:
        return add_particles(renderer, part, extent, options)
    if part.is_obstacles:
        renderer.AddActor(obstacle_actor(part.data, extent.corners(), part.is_flat()))
        return None
    field = part.colour_field(options.field)
    data = part.warped(options.warp)
    transfer, is_vector = None, False
    if field:
        limits = extent.range_of(part, field, options)
        table = colour_table(field, part.is_bodies, limits)
        transfer = transfer_function(table, limits)
        is_vector = data.GetPointData().GetArray(field).GetNumberOfComponents() > 1
    if part.is_bodies:
        for actor in (surface_actor(data, field, transfer, part.is_flat()),
                      edge_actor(data, part.is_flat())):
            if part.is_flat():  # in front of the fluid
                actor.SetPosition(0, 0, 1e-3 * data.GetLength())
            renderer.AddActor(actor)
        return field and (True, field, transfer)
    renderer.AddActor(box_actor(data.GetBounds()))
    if part.is_flat():
        renderer.AddActor(surface_actor(data, field, transfer, True))
    elif field is None or is_vector or field == "pressure":
        renderer.AddActor(surface_actor(middle_slice(data), field, transfer, True))
    else:
        renderer.AddVolume(cloud(data, field, table, limits))
    return field and (False, field, transfer)
