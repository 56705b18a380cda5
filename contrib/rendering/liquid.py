# SPDX-License-Identifier: LGPL-2.1-or-later
"""What particles fill, with a smooth surface: water, and solid bodies."""
import vtk

from .actors import particle_actor, surface_actor
from .colours import WATER
from .particle_part import INSIDE

WATER_OPACITY, COLOURED_OPACITY = 0.6, 0.85  # bodies under water are seen
DROP = 0.7  # diameter of particles on their own, in spacings
ALONE = 0.24  # share of the kernel around such a particle; 0.29 in the corner of a box of particles


def surface_props(part, meaning, is_flat):
    """What particles fill, and the drops that are too few to fill anything."""
    filled = part.region() if is_flat else surface_of(part)
    actor = surface_actor(filled, meaning, is_flat, shine=0.5)
    spray = particle_actor(drops(part), DROP * part.spacing, meaning, is_flat)
    for each in (actor, spray):
        if part.is_fluid() and not meaning:
            each.GetProperty().SetColor(*WATER)
    if part.is_fluid() and not is_flat:
        actor.GetProperty().SetOpacity(COLOURED_OPACITY if meaning else WATER_OPACITY)
    return [actor, spray]


def surface_of(part):
    """Of particles in space: the surface of what they fill, with smooth normals and all fields."""
    contour = vtk.vtkFlyingEdges3D()
    contour.SetInputData(part.continuous())
    contour.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "inside")
    contour.SetValue(0, INSIDE)
    contour.ComputeNormalsOff()
    contour.InterpolateAttributesOn()
    smooth = vtk.vtkWindowedSincPolyDataFilter()
    smooth.SetInputConnection(contour.GetOutputPort())
    smooth.SetNumberOfIterations(12)
    smooth.SetPassBand(0.1)
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputConnection(smooth.GetOutputPort())
    normals.SplittingOff()
    normals.Update()
    return normals.GetOutput()


def drops(part):
    """The particles that have no neighbours to fill anything with."""
    probe = vtk.vtkProbeFilter()
    probe.SetInputData(part.data)
    probe.SetSourceData(part.continuous())
    probe.Update()
    inside = probe.GetOutput().GetPointData().GetArray("inside")
    data = part.data.NewInstance()
    data.ShallowCopy(part.data)
    data.GetPointData().AddArray(inside)
    threshold = vtk.vtkThreshold()
    threshold.SetInputData(data)
    threshold.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "inside")
    threshold.SetThresholdFunction(vtk.vtkThreshold.THRESHOLD_LOWER)
    threshold.SetLowerThreshold(ALONE)
    threshold.Update()
    return threshold.GetOutput()
