# SPDX-License-Identifier: LGPL-2.1-or-later
"""The particles of a fluid, of bodies or of walls, and the continuous fields that they stand for."""
import vtk

from .part import Part, read, selected
from .vorticity import with_vorticity

REACH = 1.2  # smoothing length of fields between particles, in spacings
FINENESS = 2  # points of the grid of such a field, in a spacing
MOST_POINTS = 3_000_000  # of that grid
INSIDE = 0.5  # share of the kernel within a liquid, at its surface


class ParticlePart(Part):
    """The particles of one kind at one time, where they are."""

    is_particles = True
    KINDS = {"fluid": (0, 0), "bodies": (1, 1), "walls": (2, 3)}

    def __init__(self, data, name, spacing):
        self.data = selected(data, "kind", *self.KINDS[name])
        self.note_fields()
        self.is_bodies = name == "bodies"
        self.is_obstacles = name == "walls"
        self.spacing = spacing
        self.filled = None
        self.surface = None

    def colour_field(self, wanted):
        if self.is_obstacles:
            return None
        return wanted if wanted in self.fields else "displacement" if self.is_bodies else "velocity"

    def warped(self, factor):
        return self.data

    def derive_vorticity(self):
        """By differences on the grid of the continuous field."""
        grid = with_vorticity(self.continuous(), self.is_flat())
        probe = vtk.vtkProbeFilter()
        probe.SetInputData(self.data)
        probe.SetSourceData(grid)
        probe.Update()
        self.data.GetPointData().AddArray(probe.GetOutput().GetPointData().GetArray("vorticity"))
        self.note_fields()
        self.filled = None

    def continuous(self):
        """On a grid around the particles: all fields, as means over neighbours, and 'inside', the share of the kernel that
        is filled by particles: 1 well within, 0.5 at a plane surface."""
        if self.filled is None:
            self.filled = interpolated(self.data, self.spacing, self.is_flat())
        return self.filled

    def region(self):
        """What the particles fill, with all fields."""
        clip = vtk.vtkTableBasedClipDataSet()
        clip.SetInputData(self.continuous())
        clip.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "inside")
        clip.SetValue(INSIDE)
        clip.Update()
        return clip.GetOutput()


def grid_around(data, spacing, is_flat):
    """Points of a regular grid around particles, with room for their kernels."""
    bounds, image = data.GetBounds(), vtk.vtkImageData()
    axes = 2 if is_flat else 3
    room = 2 * spacing
    volume = 1.0
    for axis in range(axes):
        volume *= bounds[2 * axis + 1] - bounds[2 * axis] + 2 * room
    width = max(spacing / FINENESS, (volume / MOST_POINTS) ** (1 / axes))
    counts = [round((bounds[2 * a + 1] - bounds[2 * a] + 2 * room) / width) + 1 if a < axes else 1 for a in range(3)]
    image.SetOrigin(*(bounds[2 * a] - (room if a < axes else 0) for a in range(3)))
    image.SetSpacing(width, width, width)
    image.SetDimensions(*counts)
    return image


def interpolated(data, spacing, is_flat):
    axes = 2 if is_flat else 3
    mass, density = vtk.vtkFloatArray(), vtk.vtkFloatArray()  # a particle fills the volume spacing^axes
    for array, name, value in ((mass, "mass", spacing ** axes), (density, "density", 1)):
        array.SetName(name)
        array.SetNumberOfTuples(data.GetNumberOfPoints())
        array.FillComponent(0, value)
    weighted = data.NewInstance()
    weighted.ShallowCopy(data)
    weighted.GetPointData().AddArray(mass)
    weighted.GetPointData().AddArray(density)
    kernel = vtk.vtkSPHQuinticKernel()
    kernel.SetSpatialStep(REACH * spacing)
    kernel.SetDimension(axes)
    interpolator = vtk.vtkSPHInterpolator()
    interpolator.SetInputData(grid_around(data, spacing, is_flat))
    interpolator.SetSourceData(weighted)
    interpolator.SetKernel(kernel)
    interpolator.SetMassArrayName("mass")
    interpolator.SetDensityArrayName("density")
    interpolator.ComputeShepardSumOn()
    interpolator.ShepardNormalizationOn()
    interpolator.SetShepardSumArrayName("inside")
    interpolator.PassPointArraysOff()
    interpolator.Update()
    return interpolator.GetOutput()


def particle_parts(file, spacing):
    data = read(file)
    return [ParticlePart(data, name, spacing) for name in ParticlePart.KINDS]
