# SPDX-License-Identifier: LGPL-2.1-or-later
"""How a fluid is drawn: colours in the plane, in space a cloud or slices; particles as balls or with a surface."""
import vtk

from .actors import particle_actor, surface_actor
from .cloud import cloud
from .liquid import surface_props
from .trim import trimmed

CLOSED = 1.15  # diameter of discs in spacings, so that liquids have no holes


def cut(data, axis, place):
    """The cells of a plane."""
    plane = vtk.vtkPlane()
    plane.SetOrigin(*(place if axis == other else 0 for other in range(3)))
    plane.SetNormal(*(float(axis == other) for other in range(3)))
    cutter = vtk.vtkCutter()
    cutter.SetInputData(data)
    cutter.SetCutFunction(plane)
    cutter.Update()
    return cutter.GetOutput()


def fluid_props(part, meaning, extent, options):
    """What is drawn of a fluid that a grid has, coloured by `meaning`."""
    if extent.is_flat():
        return [surface_actor(trimmed(part.data, part.surface), meaning, True)]
    planes = options.slice
    if not planes and not (meaning and part.is_carried(meaning.field)):
        if options.vectors or options.streamlines:
            return []
        planes = [(2, part.data.GetCenter()[2])]
    if planes:
        return [surface_actor(trimmed(cut(part.data, *plane), part.surface), meaning, True) for plane in planes]
    return [cloud(part.data, meaning)]


def particle_props(part, meaning, extent, options):
    """The same for a fluid or a body of particles."""
    is_flat = extent.is_flat()
    if options.slice and not is_flat and part.is_fluid():
        return [surface_actor(cut(part.region(), *plane), meaning, True) for plane in options.slice]
    if options.surface:
        return surface_props(part, meaning, is_flat)
    return [particle_actor(part.data, (CLOSED if is_flat else 1) * part.spacing, meaning, is_flat)]
