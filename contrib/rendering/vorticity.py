# SPDX-License-Identifier: LGPL-2.1-or-later
"""The curl of a velocity."""
import vtk


def with_vorticity(data, is_flat):
    """The data with point data 'vorticity': in the plane a signed number, in space a vector."""
    gradient = vtk.vtkGradientFilter()
    gradient.SetInputData(data)
    gradient.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "velocity")
    gradient.ComputeGradientOff()
    gradient.ComputeVorticityOn()
    gradient.SetVorticityArrayName("vorticity")
    gradient.Update()
    result = gradient.GetOutput()
    if is_flat:
        vector = result.GetPointData().GetArray("vorticity")
        scalar = vtk.vtkDoubleArray()
        scalar.SetName("vorticity")
        scalar.SetNumberOfTuples(vector.GetNumberOfTuples())
        scalar.CopyComponent(0, vector, 2)
        result.GetPointData().AddArray(scalar)
    return result
