# SPDX-License-Identifier: LGPL-2.1-or-later
"""Words and colour scales below a picture."""
import vtk

from .colours import INK
from .extent import ticks

UNITS = {"displacement": "m", "velocity": "m/s", "pressure": "Pa", "temperature": "K",
         "von_Mises_stress": "Pa", "vorticity": "1/s", "vorticity_magnitude": "1/s"}
NAMES = {"velocity": "speed", "von_Mises_stress": "von Mises stress", "vorticity_magnitude": "vorticity"}
SHADES = 128


def text(words, size, left, bottom, align="Centered"):
    """`left`, `bottom`: of the last line's middle, begin or end, in pixels."""
    actor = vtk.vtkTextActor()
    actor.SetInput(words)
    prop = actor.GetTextProperty()
    prop.SetColor(*INK)
    prop.SetFontSize(size)
    prop.SetFontFamilyToArial()
    prop.ItalicOff()
    prop.BoldOff()
    prop.ShadowOff()
    getattr(prop, "SetJustificationTo" + align)()
    actor.SetPosition(left, bottom)
    return actor


def drawn_2d(data, coloured):
    mapper = vtk.vtkPolyDataMapper2D()
    mapper.SetInputData(data)
    mapper.SetScalarVisibility(coloured)
    actor = vtk.vtkActor2D()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*INK)
    return actor


def strip(meaning, left, bottom, width, height):
    """The colours from the first to the last of a scale, in pixels."""
    points, cells, colours = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkUnsignedCharArray()
    colours.SetNumberOfComponents(3)
    low, high = meaning.limits
    for k in range(SHADES):
        for x, y in ((k, 0), (k + 1, 0), (k + 1, 1), (k, 1)):
            points.InsertNextPoint(left + x * width / SHADES, bottom + y * height, 0)
        cells.InsertNextCell(4, range(4 * k, 4 * k + 4))
        shade = meaning.transfer.GetColor(low + (k + 0.5) / SHADES * (high - low))
        colours.InsertNextTuple3(*(255 * c for c in shade))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    data.GetCellData().SetScalars(colours)
    return drawn_2d(data, True)


def rules(places, left, bottom, width, height):
    """A frame around the strip, and a short line at every tick; in pixels."""
    points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
    lines = [[(left, bottom), (left + width, bottom), (left + width, bottom + height), (left, bottom + height), (left, bottom)]]
    lines += [[(x, bottom), (x, bottom - 0.35 * height)] for x in places]
    for line in lines:
        cells.InsertNextCell(len(line))
        for x, y in line:
            cells.InsertCellPoint(points.InsertNextPoint(x, y, 0))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetLines(cells)
    return drawn_2d(data, False)


def title(meaning):
    owner = "bodies: " if meaning.is_bodies and meaning.field != "displacement" else ""
    name = NAMES.get(meaning.field, meaning.field.replace("_", " "))
    unit = UNITS.get(meaning.field)
    return owner + name + (f" [{unit}]" if unit else "")


def label(value):
    return f"{value:.4g}"


def legible(values, scale, size):
    """Those of evenly spaced values whose labels do not touch; `scale`: pixels a unit."""
    widest = 0.5 * size * (max(map(len, map(label, values)), default=0) + 1)
    stride = max(1, -(-widest // (scale * (values[1] - values[0]))) if len(values) > 1 else 1)
    return values[::int(stride)]


def colour_scale(meaning, left, width, size):
    """Actors for what colours mean, below a picture; `size`: of letters, in pixels."""
    low, high = meaning.limits
    bottom, height = round(1.75 * size), round(0.75 * size)
    shown = legible(ticks(low, high), width / (high - low), size)
    places = [left + (value - low) / (high - low) * width for value in shown]
    actors = [strip(meaning, left, bottom, width, height), rules(places, left, bottom, width, height),
              text(title(meaning), size, left + width / 2, bottom + 1.45 * height)]
    return actors + [text(label(value), size, place, round(0.35 * size)) for value, place in zip(shown, places)]
