# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading what a run wrote for ParaView: solution.pvd and the files it names."""
import json
import sys
import xml.etree.ElementTree

import vtk


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


def by_fraction(data):
    """A fluid among bodies: voxels in bodies left out, those with most fluid last, so that they are
    drawn over others in the same cell."""
    append = vtk.vtkAppendFilter()
    for low, high in ((1e-12, 0.5), (0.5, 2.0)):
        threshold = vtk.vtkThreshold()
        threshold.SetInputData(data)
        threshold.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS,
                                         "fluid_fraction")
        threshold.SetLowerThreshold(low)
        threshold.SetUpperThreshold(high)
        append.AddInputConnection(threshold.GetOutputPort())
    append.Update()
    return append.GetOutput()


class Part:
    """Bodies, obstacles or fluid at one time: a data set with point data."""

    READERS = {".vtu": "vtkXMLUnstructuredGridReader", ".pvtu": "vtkXMLPUnstructuredGridReader",
               ".vti": "vtkXMLImageDataReader", ".pvti": "vtkXMLPImageDataReader",
               ".vtr": "vtkXMLRectilinearGridReader", ".pvtr": "vtkXMLPRectilinearGridReader"}

    def __init__(self, file):
        if file.suffix not in self.READERS:
            raise ValueError(f"'{file}': files {file.suffix} cannot be read")
        reader = getattr(vtk, self.READERS[file.suffix])()
        reader.SetFileName(str(file))
        reader.Update()
        to_points = vtk.vtkCellDataToPointData()
        data = reader.GetOutput()
        among_bodies = data.GetPointData().HasArray("fluid_fraction")
        to_points.SetInputData(by_fraction(data) if among_bodies else with_common_points(data))
        to_points.Update()
        self.data = to_points.GetOutput()
        point_data = self.data.GetPointData()
        self.fields = [point_data.GetArrayName(i) for i in range(point_data.GetNumberOfArrays())]
        self.is_bodies = "displacement" in self.fields
        self.is_obstacles = name_of(file) == "obstacles"

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
        carried = [name for name in self.fields
                   if name not in ("pressure", "vorticity_magnitude", "component", "fluid_fraction")
                   and self.data.GetPointData().GetArray(name).GetNumberOfComponents() == 1]
        for name in ["smoke", "temperature"] + carried + ["velocity", "pressure"]:
            if name in self.fields:
                return name
        return None

    def warped(self, factor):
        """Where the bodies are now."""
        if not self.is_bodies or factor == 0:
            return self.data
        self.data.GetPointData().SetActiveVectors("displacement")
        warp = vtk.vtkWarpVector()
        warp.SetInputData(self.data)
        warp.SetScaleFactor(factor)
        warp.Update()
        return warp.GetOutput()

    def range_of(self, field):
        return self.data.GetPointData().GetArray(field).GetRange(-1)


def read_times(results):
    """Pairs (time, files) in the order of solution.pvd."""
    pvd = results / "solution.pvd"
    if not pvd.is_file():
        sys.exit(f"render: '{pvd}' is not there: is '{results}' the folder of a run with output 'vtu'?")
    times = {}
    for data_set in xml.etree.ElementTree.parse(pvd).iter("DataSet"):
        files = times.setdefault(float(data_set.get("timestep", "0")), [])
        files.append(results / data_set.get("file"))
    return sorted(times.items())


def warp_of_files(results):
    """By what share of the displacement the points in the files are moved already."""
    try:
        parameters = json.loads((results / "parameters.json").read_text())
        return 1.0 if parameters["Output"]["vtu"]["Bodies"] == "deformed" else 0.0
    except (OSError, ValueError, KeyError):
        return 0.0


def read_parts(files):
    """The parts of one time that exist, are not empty, and are drawn: obstacles are, but not the
    pieces into which the grid cuts all surfaces."""
    parts = [Part(file) for file in files if file.is_file() and name_of(file) != "surface"]
    return [part for part in parts if not part.is_empty()]


class Extent:
    """What must be known of all frames before the first is drawn."""

    def __init__(self):
        self.bounds = vtk.vtkBoundingBox()
        self.ranges = {}  # by (is_bodies, field)

    def add(self, part, options):
        if part.is_obstacles:  # they may reach out of the domain
            return
        field = part.colour_field(options.field)
        self.bounds.AddBounds(part.warped(options.warp).GetBounds())
        if field:
            low, high = part.range_of(field)
            old = self.ranges.get((part.is_bodies, field), (low, high))
            self.ranges[part.is_bodies, field] = (min(low, old[0]), max(high, old[1]))

    def range_of(self, part, field, options):
        if options.range and field == options.field:
            return options.range
        low, high = self.ranges[part.is_bodies, field]
        if low < 0 < high and min(-low, high) > 0.05 * max(-low, high):
            low, high = -max(-low, high), max(-low, high)
        if 0 < low < 1e-6 * high:
            low = 0
        if high <= low:
            high = low + (abs(low) or 1) * 1e-3
        return low, high

    def corners(self):
        bounds = [0.0] * 6
        self.bounds.GetBounds(bounds)
        return bounds
