# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colours and what they mean. Fluids are cool, bodies warm, so that both can be told apart in any picture."""
import vtk

PAPER = "#e9eef3"  # behind all: neither white nor grey, so that smoke, steel and foam stand out
INK = (0.12, 0.12, 0.15)
GREY = (0.55, 0.55, 0.57)  # obstacles
WALL = (0.60, 0.66, 0.72)
WATER = (0.10, 0.42, 0.66)

# Lightness grows evenly from the first to the last, so that they are in order for the colour-blind too.
SPEED = ["#153b8b", "#1852a2", "#1a6f9d", "#1f8b92", "#3aa67f", "#93b93d", "#f0bc22"]
BODIES = ["#a32b4a", "#c24048", "#dc5c3c", "#ec7f2f", "#f6a335", "#fccb51"]
SMOKE = ["#ffffff", "#c9c9c9", "#8c8c8c", "#4d4d4d", "#1a1a1a"]
DYE = ["#ffffff", "#dcc6e6", "#b287c6", "#863f9e", "#4f1268"]
HEAT = ["#f7e3b5", "#fdbb6b", "#f5813f", "#c9302b", "#6b0f1a"]
SIGNED = ["#1d4f91", "#5b93c7", "#a9c3dc", "#d4d5d2", "#e3b098", "#d66a52", "#96172c"]


def rgb(colour):
    return [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]


def luminance(colour):
    """Relative luminance of a colour '#rrggbb', as WCAG 2.1 defines it."""
    red, green, blue = (c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in rgb(colour))
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one, other):
    """Contrast ratio of two colours, 1 to 21, as WCAG 2.1 defines it."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def colour_table(field, limits, is_bodies=False, is_carried=False):
    if limits[0] < 0 < limits[1]:
        return SIGNED
    if is_bodies:
        return BODIES
    return {"smoke": SMOKE, "temperature": HEAT, "heat": HEAT}.get(field, DYE if is_carried else SPEED)


def transfer_function(table, limits):
    """Colours of `table` from the first to the last of `limits`; of vectors, by their length."""
    low, high = limits
    transfer = vtk.vtkColorTransferFunction()
    for number, colour in enumerate(table):
        share = number / (len(table) - 1)
        transfer.AddRGBPoint(low + share * (high - low), *rgb(colour))
    return transfer


class Meaning:
    """What colours mean: a field of bodies or of a fluid, between limits."""

    def __init__(self, part, field, limits):
        self.is_bodies, self.field, self.limits = part.is_bodies, field, limits
        self.table = colour_table(field, limits, part.is_bodies, part.is_carried(field))
        largest = max(map(abs, limits))  # both signs: the middle of the colours is at 0
        self.transfer = transfer_function(self.table, (-largest, largest) if self.table is SIGNED else limits)

    def key(self):
        return self.is_bodies, self.field

    def apply(self, mapper, data):
        """Colour what a mapper draws of `data`; nothing has no fields, either."""
        if data.GetNumberOfPoints() == 0:
            return
        mapper.ScalarVisibilityOn()
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(self.field)
        if data.GetPointData().GetArray(self.field).GetNumberOfComponents() > 1:
            self.transfer.SetVectorModeToMagnitude()
        mapper.SetLookupTable(self.transfer)
        mapper.UseLookupTableScalarRangeOn()
