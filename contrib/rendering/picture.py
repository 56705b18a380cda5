# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing bodies, obstacles and fluid at one time."""
import math

import vtk

DIRECTIONS = {"front": (0, 0, 1), "back": (0, 0, -1), "left": (-1, 0, 0), "right": (1, 0, 0),
              "top": (0, 1, 1e-3), "bottom": (0, -1, 1e-3), "oblique": (0.55, 0.4, 1)}
UNITS = {"displacement": "m", "velocity": "m/s", "pressure": "Pa", "temperature": "K",
         "von_Mises_stress": "Pa", "vorticity_magnitude": "1/s"}
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
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(edges.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*INK)
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
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(faces.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*GREY)
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
    for share, value in ((0, 0), (0.01, 0), (0.15, 0.1), (1, 0.5)):
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


def text_property(prop, size):
    prop.SetColor(*INK)
    prop.SetFontSize(size)
    prop.SetFontFamilyToArial()
    prop.ItalicOff()
    prop.BoldOff()
    prop.ShadowOff()


def colour_bar(transfer, is_bodies, options):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(transfer)
    bar.UnconstrainedFontSizeOn()
    size = max(10, options.height // 42)
    text_property(bar.GetLabelTextProperty(), size)
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%-.3g")
    bar.SetOrientationToVertical()
    bar.SetBarRatio(0.23)
    bar.SetWidth(0.095)
    bar.SetHeight(0.6)
    bar.SetTitle("")
    bar.SetPosition(0.9 if is_bodies else 0.015, 0.2)
    return bar


def bar_title(field, is_bodies, options):
    owner = "bodies: " if is_bodies and field != "displacement" else ""
    name = "speed" if field == "velocity" else field.replace("_", " ")
    title = vtk.vtkTextActor()
    title.SetInput(owner + name + (f" [{UNITS[field]}]" if field in UNITS else ""))
    text_property(title.GetTextProperty(), max(10, options.height // 42))
    if is_bodies:
        title.GetTextProperty().SetJustificationToRight()
    title.SetPosition(options.width * (0.985 if is_bodies else 0.015), options.height * 0.815)
    return title


def time_stamp(time, options):
    stamp = vtk.vtkTextActor()
    stamp.SetInput(f"t = {time:.4g} s")
    text_property(stamp.GetTextProperty(), max(12, options.height // 30))
    stamp.SetPosition(options.width * 0.45, options.height * 0.02)
    return stamp


def add_part(renderer, part, extent, options):
    if part.is_obstacles:
        renderer.AddActor(obstacle_actor(part.data, extent.corners(), part.is_flat()))
        return
    field = part.colour_field(options.field)
    data = part.warped(options.warp)
    transfer, is_vector = None, False
    if field:
        limits = extent.range_of(part, field, options)
        table = colour_table(field, part.is_bodies, limits)
        transfer = transfer_function(table, limits)
        is_vector = data.GetPointData().GetArray(field).GetNumberOfComponents() > 1
        renderer.AddActor2D(colour_bar(transfer, part.is_bodies, options))
        renderer.AddActor2D(bar_title(field, part.is_bodies, options))
    if part.is_bodies:
        for actor in (surface_actor(data, field, transfer, part.is_flat()),
                      edge_actor(data, part.is_flat())):
            if part.is_flat():  # in front of the fluid
                actor.SetPosition(0, 0, 1e-3 * data.GetLength())
            renderer.AddActor(actor)
        return
    renderer.AddActor(box_actor(data.GetBounds()))
    if part.is_flat():
        renderer.AddActor(surface_actor(data, field, transfer, True))
    elif field is None or is_vector or field == "pressure":
        renderer.AddActor(surface_actor(middle_slice(data), field, transfer, True))
    else:
        renderer.AddVolume(cloud(data, field, table, limits))


def aim(camera, bounds, options):
    """Fit the box into the middle of the picture, between the colour bars."""
    flat = bounds[5] - bounds[4] <= 1e-9 * (bounds[1] - bounds[0])
    view = options.camera or ("front" if flat else "oblique")
    direction = DIRECTIONS[view] if isinstance(view, str) else view
    centre = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(centre)
    # Outside the box: a cloud seen from within itself is not drawn.
    away = 2 * sum(bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3))
    length = sum(d * d for d in direction) ** 0.5
    camera.SetPosition([c + away * d / length for c, d in zip(centre, direction)])
    camera.SetViewUp(0, 1, 0)
    camera.OrthogonalizeViewUp()
    transform = camera.GetViewTransformMatrix()
    corners = [transform.MultiplyPoint((bounds[i], bounds[2 + j], bounds[4 + k], 1))
               for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    half = [max(abs(corner[axis]) for corner in corners) for axis in (0, 1)]
    aspect = options.width / options.height
    camera.SetParallelScale(max(half[1] / 0.86, half[0] / (0.7 * aspect)) / options.zoom)


class Painter:
    """Draws one time after the other into files."""

    def __init__(self, extent, options):
        self.extent = extent
        self.options = options
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetSize(options.width, options.height)

    def paint(self, parts, time, file):
        renderer = vtk.vtkRenderer()
        renderer.SetBackground(1, 1, 1)
        for part in parts:
            add_part(renderer, part, self.extent, self.options)
        renderer.AddActor2D(time_stamp(time, self.options))
        aim(renderer.GetActiveCamera(), self.extent.corners(), self.options)
        renderer.ResetCameraClippingRange()
        self.window.AddRenderer(renderer)
        self.window.Render()
        picture = vtk.vtkWindowToImageFilter()
        picture.SetInput(self.window)
        picture.ReadFrontBufferOff()
        writer = vtk.vtkPNGWriter()
        writer.SetFileName(str(file))
        writer.SetInputConnection(picture.GetOutputPort())
        writer.Write()
        self.window.RemoveRenderer(renderer)
