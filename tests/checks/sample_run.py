# SPDX-License-Identifier: LGPL-2.1-or-later
"""A small made-up folder of results with every file that a page about a run is made of."""
import base64
import json
import os
import struct
import zlib

import numpy

COLUMNS = [("Step", "1"), ("Time", "s"), ("Step length", "s"), ("Newton iterations", "1"), ("Fluid kinetic energy", "J"),
           ("Fluid divergence", "1"), ("solid elastic energy", "J"), ("energy gain", "J"), ("energy by forces", "J"),
           ("energy by friction", "J"), ("energy by sides", "J"), ("energy by gravity", "J"), ("centre of mass bar x", "m"), ("centre of mass bar y", "m"),
           ("tip displacement x", "m"), ("tip displacement y", "m"), ("Cut cells", "1")]
FAILURE = ("step 8, which begins at 0.07 s: body 'bar': the volume ratio is -0.1 <b>. Try: a shorter 'Time / Step'.\n"
           "The state before it is kept; 'undine resume DIR --set \"Section/Key=value\"' continues it.")


def rows_of(n_rows, seed=1):
    """Rows (n_rows, columns) with ten digits, as the program writes them."""
    random, times = numpy.random.default_rng(seed), 0.01 * numpy.arange(n_rows)
    forces, friction = random.normal(size=n_rows), -random.random(n_rows)
    values = [numpy.arange(n_rows), times, numpy.where(times > 0, 0.01, 0), 3 + random.integers(0, 3, n_rows),
              1 + numpy.sin(times), 10.0 ** random.uniform(-9, -3, n_rows), random.random(n_rows), forces + friction, forces,
              friction, 0 * times, forces / 2, numpy.sin(times), numpy.cos(times), random.normal(size=n_rows), times**2, numpy.full(n_rows, 8)]
    return numpy.array([[float(f"{value:.9e}") for value in column] for column in values]).T


def statistics(rows, columns=tuple(COLUMNS)):
    head = "".join(f"# {k}: {name} [{unit}]\n" for k, (name, unit) in enumerate(columns, 1))
    return head + "".join("".join(f"{value:18.9e}" for value in row) + "\n" for row in rows)


def data_array(name, values, kind, components=1):
    """Compressed as deal.II does, but in two blocks."""
    raw = numpy.ascontiguousarray(values, kind).tobytes()
    half = len(raw) // 2
    blocks = [zlib.compress(raw[:half]), zlib.compress(raw[half:])]
    head = struct.pack("<5I", 2, max(half, 1), len(raw) - half, *map(len, blocks))
    names = {"<f8": "Float64", "<i4": "Int32", "<u1": "UInt8"}
    return (f'<DataArray type="{names[kind]}" Name="{name}" NumberOfComponents="{components}" format="binary">\n'
            f"{(base64.b64encode(head) + base64.b64encode(b''.join(blocks))).decode()}\n</DataArray>\n")


def vtu(points, cells, kind, fields):
    """A mesh of one kind of cells: points (n, 3), cells (m, corners), fields {name: (n, components)}."""
    arrays = "".join(data_array(name, values, "<f8", values.shape[1]) for name, values in fields.items())
    return (f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" compressor="vtkZLibDataCompressor"><UnstructuredGrid>\n'
            f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">\n<Points>\n'
            f'{data_array("", points, "<f8", 3)}</Points>\n<Cells>\n{data_array("connectivity", cells, "<i4")}'
            f'{data_array("offsets", cells.shape[1] * (1 + numpy.arange(len(cells))), "<i4")}'
            f'{data_array("types", numpy.full(len(cells), kind), "<u1")}</Cells>\n<PointData>\n{arrays}</PointData>\n</Piece>\n'
            "</UnstructuredGrid></VTKFile>\n")


def box(n, dimension, extent=1.0):
    """Points and cells of n^dimension squares or cubes, each with corners of its own, as the program writes the fluid."""
    unit = numpy.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)][:2**dimension])
    places = numpy.stack(numpy.meshgrid(*[numpy.arange(n)] * dimension, indexing="ij"), axis=-1).reshape(-1, dimension)
    places = numpy.pad(places, ((0, 0), (0, 3 - dimension)))
    points = (places[:, None] + unit[None]).reshape(-1, 3) * extent / n
    return points, numpy.arange(len(points)).reshape(-1, 2**dimension)


def certificate(verdict, text):
    return {"verdict": verdict, "text": text, "steps": 7, "steps redone": 0, "margins": [
        {"law": "energy", "value": 0.01, "bound": 0.1, "margin": 0.9, "meaning": "created by all steps"}]}


def summary(verdict="stable", failure=""):
    return {"program": "undine 0.1.0", "title": "A sample", "scene": "sample.prm", "dimension": 2, "ranks": 1, "ended": not failure,
            "failure": failure, "begin [s]": 0, "time [s]": 0.07, "end [s]": 0.07 if not failure else 1, "steps": 7, "step cuts": 0,
            "Newton iterations": 20, "linear iterations": 0, "unknowns": {"cells of the fluid": 64},
            "cost": {"wall seconds": 1.5, "core seconds": 1.4, "core seconds of the start": 0.1, "peak memory [bytes]": 1e8},
            "tolerances": {}, "time is estimated": False, "errors": [{"kind": "mass", "largest": 1e-9, "meaning": "divergence"}],
            "certificate": certificate(verdict, f"failed at t = 0.07 s: {failure}" if failure else verdict)}


EFFECTS = {"ranks": 1, "seconds": 1.5, "effects": [
    {"name": "gravity", "on": True, "why": "Effects / gravity", "rule": "", "phases": [], "calls": 3, "seconds": 0.3,
     "bytes at start": 0, "peak bytes": 1000},
    {"name": "viscosity", "on": False, "why": "no subsection", "rule": "", "phases": [], "calls": 0, "seconds": 0,
     "bytes at start": 0, "peak bytes": 0}], "numbers": [{"name": "Reynolds number", "value": 120, "meaning": "U L / nu"}],
    "advice": [{"effect": "viscosity", "on": False, "matters": True, "number": "Reynolds number", "value": 120, "rule": "below 1000"}],
    "columns not found": []}
TIMING = ("# phase                                          calls       seconds        %\n"
          "initialise                                           1        0.5000     33.3\n"
          "step                                                 7        1.0000     66.7\n"
          "  pressure                                           7        0.7500     75.0\n")
PARAMETERS = ("set Title = A sample\n# default: Scheme = simultaneous\n\nsubsection Time\n  set Step = 0.01  # [s]\n"
              "  # default: Tolerance = 0\nend\n\nsubsection Probes\n\n  subsection tip\n    set Kind = point\n  end\nend\n")


def files(n_rows=8, verdict="stable", failure=""):
    """{name: text} of all files of a run."""
    points, cells = box(8, 2)
    pvd = "".join(f'<DataSet timestep="{time}" part="0" name="fluid" file="solution/fluid_{step:06d}.vtu"/>'
                  for step, time in ((0, 0), (7, 0.07)))
    fluid = vtu(points, cells, 9, {"velocity": numpy.cos(points), "pressure": points[:, :1]})
    return {"statistics": statistics(rows_of(n_rows)), "summary.json": json.dumps(summary(verdict, failure)),
            "effects.json": json.dumps(EFFECTS), "timing": TIMING, "parameters.prm": PARAMETERS, "original.prm": "",
            "parameters.json": json.dumps({"Title": "A sample", "Time": {"Step": "0.01"}, "Probes": {"tip": {"Kind": "point"}}}),
            "record.txt": "# Files\nfile statistics\nrun has begun\nrun has ended\n",
            "solution.pvd": f'<VTKFile type="Collection"><Collection>{pvd}</Collection></VTKFile>',
            "solution/fluid_000000.vtu": fluid, "solution/fluid_000007.vtu": fluid, "checkpoint/slot_0.h5": ""}


def write(folder, **keys):
    """Make the folder of a run; `keys` of files(). Returns its path."""
    for name, text in files(**keys).items():
        path = os.path.join(folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w") as file:
            file.write(text)
    return folder
