# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a fluid carries in space as a soft translucent cloud: denser where there is more of it."""
import vtk

from .colours import DYE, SMOKE, transfer_function

FINENESS = 160  # points along the longest side
THINNEST = 0.03  # share of the scale that is seen
DENSEST = 0.12  # opacity along a fortieth of the longest side: a tenth of the light passes half of a box that is full
SOOT = ["#5c6674", "#39414d", "#20252d"]  # clouds are light because they are translucent: their colour need not be light


def dark(table):
    """Clouds are light because they are translucent: their colours need not be light too."""
    return SOOT if table is SMOKE else DYE[2:] if table is DYE else table


def cloud(data, meaning):
    bounds = data.GetBounds()
    lengths = [bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3)]
    spacing = max(lengths) / FINENESS
    resample = vtk.vtkResampleToImage()
    resample.SetInputDataObject(data)
    resample.SetSamplingDimensions(*(max(2, round(length / spacing)) for length in lengths))
    resample.Update()
    image = resample.GetOutput()
    image.GetPointData().SetActiveScalars(meaning.field)
    mapper = vtk.vtkOpenGLGPUVolumeRayCastMapper()
    mapper.SetInputData(image)
    mapper.UseJitteringOn()
    low, high = meaning.limits
    opacity = vtk.vtkPiecewiseFunction()
    for share, value in ((0, 0), (THINNEST, 0), (1, DENSEST)):
        opacity.AddPoint(low + share * (high - low), value)
    volume = vtk.vtkVolume()
    volume.SetMapper(mapper)
    volume.GetProperty().SetColor(transfer_function(dark(meaning.table), meaning.limits))
    volume.GetProperty().SetScalarOpacity(opacity)
    volume.GetProperty().SetScalarOpacityUnitDistance(max(lengths) / 40)
    volume.GetProperty().SetInterpolationTypeToLinear()
    return volume
