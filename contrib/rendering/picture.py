# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drawing one run, or two side by side, at one time into a picture."""
import vtk

from .actors import INK, add_part

DIRECTIONS = {"front": (0, 0, 1), "back": (0, 0, -1), "left": (-1, 0, 0), "right": (1, 0, 0),
              "top": (0, 1, 1e-3), "bottom": (0, -1, 1e-3), "oblique": (0.55, 0.4, 1)}
UNITS = {"displacement": "m", "velocity": "m/s", "pressure": "Pa", "temperature": "K",
         "von_Mises_stress": "Pa", "vorticity_magnitude": "1/s"}
ASIDE = {1: 0.15, 2: 0.1}  # share of the width for colour bars at either side, by number of views


def text_property(prop, size):
    prop.SetColor(*INK)
    prop.SetFontSize(size)
    prop.SetFontFamilyToArial()
    prop.ItalicOff()
    prop.BoldOff()
    prop.ShadowOff()


def text(words, size, left, bottom):
    """`left`, `bottom`: of the last line's middle, in pixels."""
    actor = vtk.vtkTextActor()
    actor.SetInput(words)
    text_property(actor.GetTextProperty(), size)
    actor.GetTextProperty().SetJustificationToCentered()
    actor.SetPosition(left, bottom)
    return actor


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
    bar.SetWidth(0.095 * options.height / options.width * 16 / 9)
    bar.SetHeight(0.6)
    bar.SetTitle("")
    bar.SetPosition(0.995 - bar.GetWidth() if is_bodies else 0.015, 0.2)
    return bar


def bar_title(field, is_bodies, options):
    owner = "bodies: " if is_bodies and field != "displacement" else ""
    name = "speed" if field == "velocity" else field.replace("_", " ")
    title = text(owner + name + (f" [{UNITS[field]}]" if field in UNITS else ""),
                 max(10, options.height // 42),
                 options.width * (0.985 if is_bodies else 0.015), options.height * 0.815)
    if is_bodies:
        title.GetTextProperty().SetJustificationToRight()
    else:
        title.GetTextProperty().SetJustificationToLeft()
    return title


def aim(camera, bounds, options, aspect):
    """Fit the box into the middle of a view with this ratio of width to height."""
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
    camera.SetParallelScale(max(half[1] / 0.86, half[0] / aspect) / options.zoom)


class Painter:
    """Draws one time after the other into files."""

    def __init__(self, extent, options):
        self.extent = extent
        self.options = options
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SetNumberOfLayers(2)
        self.window.SetSize(options.width, options.height)

    def paint(self, views, time, file):
        """`views`: pairs of parts and the words above them, from left to right."""
        width, height = self.options.width, self.options.height
        aside = ASIDE[len(views)]
        share = (1 - 2 * aside) / len(views)
        paper, legend = vtk.vtkRenderer(), vtk.vtkRenderer()  # behind and before all views
        paper.SetBackground(1, 1, 1)
        legend.SetLayer(1)
        renderers, meanings = [paper], {}
        for number, (parts, words) in enumerate(views):
            renderer = vtk.vtkRenderer()
            renderer.SetBackground(1, 1, 1)
            left = aside + number * share
            renderer.SetViewport(left, 0, left + share, 1)
            for meaning in [add_part(renderer, part, self.extent, self.options) for part in parts]:
                if meaning:
                    meanings[meaning[0]] = meaning
            aim(renderer.GetActiveCamera(), self.extent.corners(), self.options,
                0.97 * share * width / height)
            renderer.ResetCameraClippingRange()
            renderers.append(renderer)
            legend.AddActor2D(text(words, max(11, height // 36), (left + share / 2) * width,
                                   0.9 * height))
        for is_bodies, field, transfer in meanings.values():
            legend.AddActor2D(colour_bar(transfer, is_bodies, self.options))
            legend.AddActor2D(bar_title(field, is_bodies, self.options))
        legend.AddActor2D(text(f"t = {time:.4g} s", max(12, height // 30), width / 2,
                               0.02 * height))
        self.write(renderers + [legend], file)

    def write(self, renderers, file):
        for renderer in renderers:
            self.window.AddRenderer(renderer)
        self.window.Render()
        picture = vtk.vtkWindowToImageFilter()
        picture.SetInput(self.window)
        picture.ReadFrontBufferOff()
        writer = vtk.vtkPNGWriter()
        writer.SetFileName(str(file))
        writer.SetInputConnection(picture.GetOutputPort())
        writer.Write()
        for renderer in renderers:
            self.window.RemoveRenderer(renderer)
