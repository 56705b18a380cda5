# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading what a run wrote for ParaView: solution.pvd and the files it names."""
import json
import sys
import xml.etree.ElementTree

import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy


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
    where there are none the mean by the share of fluid. Cells in bodies are left out."""
    data = selected(data, "fluid_fraction", 1e-12, 2)
    if data.GetNumberOfPoints() == 0:
        return data
    points = vtk_to_numpy(data.GetPoints().GetData())
    _, corner = numpy.unique(points, axis=0, return_inverse=True)
    arrays = data.GetPointData()
    fraction = vtk_to_numpy(arrays.GetArray("fluid_fraction"))
    weight = numpy.where(fraction > 1 - 1e-6, 1e9, fraction)
    total = numpy.bincount(corner, weight)
    for name in [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())]:
        values = vtk_to_numpy(arrays.GetArray(name))  # the array's own memory
        if name not in ("component", "fluid_fraction"):
            for column in values.reshape(len(values), -1).T:
                column[:] = (numpy.bincount(corner, weight * column) / total)[corner]
    return data


class Part:
    """Bodies, obstacles or fluid at one time: a data set with point data."""

    is_particles = False

    READERS = {".vtu": "vtkXMLUnstructuredGridReader", ".pvtu": "vtkXMLPUnstructuredGridReader",
               ".vti": "vtkXMLImageDataReader", ".pvti": "vtkXMLPImageDataReader",
               ".vtr": "vtkXMLRectilinearGridReader", ".pvtr": "vtkXMLPRectilinearGridReader"}

    def __init__(self, file, moved):
        """`moved`: by what share of their displacement bodies are moved in the file."""
        if file.suffix not in self.READERS:
            raise ValueError(f"'{file}': files {file.suffix} cannot be read")
        reader = getattr(vtk, self.READERS[file.suffix])()
        reader.SetFileName(str(file))
        reader.Update()
        to_points = vtk.vtkCellDataToPointData()
        data = reader.GetOutput()
        among_bodies = data.GetPointData().HasArray("fluid_fraction")
        to_points.SetInputData(blended(data) if among_bodies else with_common_points(data))
        to_points.Update()
        self.data = to_points.GetOutput()
        point_data = self.data.GetPointData()
        self.fields = [point_data.GetArrayName(i) for i in range(point_data.GetNumberOfArrays())]
        self.is_bodies = "displacement" in self.fields
        self.is_obstacles = name_of(file) == "obstacles"
        self.moved = moved

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

    def range_of(self, field):
        return self.data.GetPointData().GetArray(field).GetRange(-1)


class ParticlePart(Part):
    """The particles of a fluid, of bodies or of walls at one time, where they are."""

    is_particles = True
    KINDS = {"fluid": (0, 0), "bodies": (1, 1), "walls": (2, 3)}

    def __init__(self, data, name, diameter):
        self.data = selected(data, "kind", *self.KINDS[name])
        point_data = self.data.GetPointData()
        self.fields = [point_data.GetArrayName(i) for i in range(point_data.GetNumberOfArrays())]
        self.is_bodies = name == "bodies"
        self.is_obstacles = name == "walls"
        self.diameter = diameter

    def colour_field(self, wanted):
        if self.is_obstacles:
            return None
        return wanted if wanted in self.fields else "velocity"

    def warped(self, factor):
        return self.data


def particle_parts(file, diameter):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return [ParticlePart(reader.GetOutput(), name, diameter) for name in ParticlePart.KINDS]


class Run:
    """The folder of a run: its times of output, and what it says of itself."""

    def __init__(self, results):
        self.results = results
        self.files = self.read_times()  # by time
        self.times = sorted(self.files)
        try:
            self.parameters = json.loads((results / "parameters.json").read_text())
        except (OSError, ValueError):
            self.parameters = {}
        bodies = self.parameters.get("Output", {}).get("vtu", {}).get("Bodies")
        self.moved = 1.0 if bodies == "deformed" else 0.0

    def read_times(self):
        pvd = self.results / "solution.pvd"
        if not pvd.is_file():
            sys.exit(f"render: '{pvd}' is not there: is '{self.results}' the folder of a run with "
                     "output 'vtu'?")
        files = {}
        for data_set in xml.etree.ElementTree.parse(pvd).iter("DataSet"):
            files.setdefault(float(data_set.get("timestep", "0")), []).append(
                self.results / data_set.get("file"))
        return files

    def interval(self):
        return (self.times[-1] - self.times[0]) / max(1, len(self.times) - 1)

    def nearest(self, time):
        return min(self.times, key=lambda own: abs(own - time))

    def stopped(self, time):
        """Was the run over at this time, before the end that it should have reached?"""
        end = float(self.parameters.get("Time", {}).get("End", 0))
        return time > self.times[-1] + 1e-9 and end > self.times[-1] + 1e-9

    def label(self):
        name = self.results.resolve().name
        step = float(self.parameters.get("Time", {}).get("Step", 0))
        scheme = self.parameters.get("Scheme", "").replace("_", " ")
        return (f"{self.parameters.get('Title', '')}\n" +
                (f"{name}: {scheme}, h = {step:.3g} s" if scheme else name))

    def parts(self, time):
        """The parts at one of its times that exist, are not empty, and are drawn: obstacles are, but
        not the pieces into which the grid cuts all surfaces."""
        parts = []
        for file in self.files[time]:
            if file.is_file() and name_of(file) == "particles":
                spacing = float(self.parameters.get("Particles", {}).get("Spacing", 0))
                parts += particle_parts(file, spacing)
            elif file.is_file() and name_of(file) != "surface":
                parts.append(Part(file, self.moved))
        return [part for part in parts if not part.is_empty()]


def film_times(runs):
    """Those of the run with the shorter interval, then what another has beyond its end."""
    lead = min(runs, key=Run.interval)
    later = {time for run in runs for time in run.times if time > lead.times[-1] + 1e-9}
    return lead.times + sorted(later)


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
