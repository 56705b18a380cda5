# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part of a solution: bodies, obstacles or the fluid of a grid at one time."""
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from .trim import WET
from .vorticity import with_vorticity

NOT_CARRIED = ("pressure", "vorticity", "vorticity_magnitude", "component", "fluid_fraction")


READERS = {".vtu": "vtkXMLUnstructuredGridReader", ".pvtu": "vtkXMLPUnstructuredGridReader",
           ".vti": "vtkXMLImageDataReader", ".pvti": "vtkXMLPImageDataReader",
           ".vtr": "vtkXMLRectilinearGridReader", ".pvtr": "vtkXMLPRectilinearGridReader"}


def read(file):
    if file.suffix not in READERS:
        raise ValueError(f"'{file}': files {file.suffix} cannot be read")
    reader = getattr(vtk, READERS[file.suffix])()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def with_common_points(data):
    """Cells and ranks write points of their own; surfaces need those of neighbours to be the same."""
    if not data.IsA("vtkUnstructuredGrid"):
        return data
    result = vtk.vtkUnstructuredGrid()
    merge = vtk.vtkMergeCells()
    merge.SetUnstructuredGrid(result)
    merge.SetTotalNumberOfDataSets(1)
    merge.SetTotalNumberOfPoints(data.GetNumberOfPoints())
    merge.SetTotalNumberOfCells(data.GetNumberOfCells())
    merge.SetPointMergeTolerance(1e-6 * data.GetLength())
    merge.MergeDataSet(data)
    merge.Finish()
    return result


def name_of(file):
    """Of the part: solution/fluid_000012.vtu holds the fluid."""
    return file.stem.rsplit("_", 1)[0]


def selected(data, field, low, high):
    """The cells all of whose points have a value of `field` in between."""
    threshold = vtk.vtkThreshold()
    threshold.SetInputData(data)
    threshold.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, field)
    threshold.SetLowerThreshold(low)
    threshold.SetUpperThreshold(high)
    threshold.Update()
    return threshold.GetOutput()


def blended(data):
    """A fluid among bodies, to be drawn as one continuous field. A cell that a body divides is there
    once for each of its parts; its corners get what the cells around say that are fluid all over,
    where there are none the mean by the share of fluid. Cells in bodies are left out. The field WET
    tells corners of cells that are fluid all over."""
    data = selected(data, "fluid_fraction", 1e-12, 2)
    if data.GetNumberOfPoints() == 0:
        return data
    points = vtk_to_numpy(data.GetPoints().GetData())
    _, corner = numpy.unique(points, axis=0, return_inverse=True)
    arrays = data.GetPointData()
    fraction = vtk_to_numpy(arrays.GetArray("fluid_fraction")).copy()
    weight = numpy.where(fraction > 1 - 1e-6, 1e9, fraction)
    total = numpy.bincount(corner, weight)
    least, most = numpy.ones(len(total)), numpy.zeros(len(total))
    numpy.minimum.at(least, corner, fraction)
    numpy.maximum.at(most, corner, fraction)
    for name in [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())]:
        values = vtk_to_numpy(arrays.GetArray(name))  # the array's own memory
        if name == "fluid_fraction":
            values[:] = least[corner]  # 1 in cells that touch no divided one
        elif name != "component":
            for column in values.reshape(len(values), -1).T:
                column[:] = (numpy.bincount(corner, weight * column) / total)[corner]
    wet = numpy_to_vtk((most > 1 - 1e-6).astype(float)[corner], deep=True)
    wet.SetName(WET)
    arrays.AddArray(wet)
    return data


class Part:
    """Bodies, obstacles or fluid at one time: a data set with point data."""

    is_particles = False

    def __init__(self, file, moved):
        """`moved`: by what share of their displacement bodies are moved in the file."""
        to_points = vtk.vtkCellDataToPointData()
        data = read(file)
        among_bodies = data.GetPointData().HasArray("fluid_fraction")
        to_points.SetInputData(blended(data) if among_bodies else with_common_points(data))
        to_points.Update()
        self.data = to_points.GetOutput()
        self.note_fields()
        self.is_bodies = "displacement" in self.fields
        self.is_obstacles = name_of(file) == "obstacles"
        self.moved = moved
        self.surface = None  # of bodies and obstacles, which the fluid does not pass
        self.joined = not among_bodies

    def note_fields(self):
        point_data = self.data.GetPointData()
        names = [point_data.GetArrayName(i) for i in range(point_data.GetNumberOfArrays())]
        self.fields = [name for name in names if name != WET]

    def is_fluid(self):
        return not self.is_bodies and not self.is_obstacles

    def is_carried(self, field):
        """Is it a number that the fluid takes along?"""
        return (self.is_fluid() and field not in NOT_CARRIED and
                self.data.GetPointData().GetArray(field).GetNumberOfComponents() == 1)

    def derive_vorticity(self):
        self.data = with_vorticity(self.region(), self.is_flat())
        self.note_fields()

    def region(self):
        """Where the fluid is, with all fields, and with cells that share points: needed from one cell to the next, and slow."""
        if not self.joined:
            self.data, self.joined = with_common_points(self.data), True
        return self.data

    def is_empty(self):
        return self.data.GetNumberOfPoints() == 0

    def is_flat(self):
        bounds = self.data.GetBounds()
        return bounds[5] - bounds[4] <= 1e-9 * (bounds[1] - bounds[0])

    def colour_field(self, wanted):
        if self.is_obstacles:
            return None
        if wanted in self.fields:
            return wanted
        if self.is_bodies:
            return "displacement"
        carried = [name for name in self.fields if self.is_carried(name)]
        for name in ["smoke", "temperature"] + carried + ["velocity", "pressure"]:
            if name in self.fields:
                return name
        return None

    def warped(self, factor):
        """Where the bodies are now, with displacements this much larger."""
        factor -= self.moved
        if not self.is_bodies or factor == 0:
            return self.data
        self.data.GetPointData().SetActiveVectors("displacement")
        warp = vtk.vtkWarpVector()
        warp.SetInputData(self.data)
        warp.SetScaleFactor(factor)
        warp.Update()
        return warp.GetOutput()

    def points(self):
        return vtk_to_numpy(self.data.GetPoints().GetData())

    def values(self, field):
        """Of vectors, their lengths."""
        values = vtk_to_numpy(self.data.GetPointData().GetArray(field))
        return numpy.linalg.norm(values, axis=1) if values.ndim > 1 else values
