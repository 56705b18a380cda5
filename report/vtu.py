# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading what a run has written for ParaView: solution.pvd, and the compressed .vtu files that it names."""
import base64
import os
import xml.etree.ElementTree
import zlib
from dataclasses import dataclass

import numpy

TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "<u1", "UInt32": "<u4", "UInt64": "<u8"}


@dataclass
class Mesh:
    """`points` (points, 3) [m]; `cells` {VTK's number of the kind: (cells, corners)}; `fields` {name: (points, components)}."""
    points: numpy.ndarray
    cells: dict
    fields: dict


def decoded(array):
    """The numbers of a <DataArray>, which is compressed or text. Throws ValueError."""
    kind, text = TYPES[array.get("type")], (array.text or "").strip()
    if array.get("format") == "ascii":
        return numpy.array(text.split(), dtype=kind)
    if not text:
        return numpy.array([], dtype=kind)
    n_blocks = numpy.frombuffer(base64.b64decode(text[:8]), "<u4", 1)[0]
    length = 4 * -(-4 * (3 + int(n_blocks)) // 3)  # of the header in base 64
    sizes = numpy.frombuffer(base64.b64decode(text[:length]), "<u4", 3 + n_blocks)[3:]
    packed, data, at = base64.b64decode(text[length:]), b"", 0
    for size in sizes:
        data += zlib.decompress(packed[at:at + size])
        at += size
    return numpy.frombuffer(data, kind)


def shaped(array):
    return decoded(array).reshape(-1, int(array.get("NumberOfComponents", "1")))


def named(parent, name):
    """{name: numbers} of all arrays in an element that may be missing."""
    found = parent.find(name)
    return {} if found is None else {each.get("Name", ""): shaped(each) for each in found.iter("DataArray")}


def cells_of(piece, first):
    """{kind: corners of its cells}; `first`: number of the first point. Polygons, which Undine does not write, are left out."""
    arrays = named(piece, "Cells")
    corners, offsets, kinds = (arrays[name].ravel() for name in ("connectivity", "offsets", "types"))
    begins = numpy.concatenate([[0], offsets[:-1]]).astype(int)
    lengths = offsets - begins
    cells = {}
    for kind in numpy.unique(kinds):
        which = numpy.flatnonzero(kinds == kind)
        if numpy.unique(lengths[which]).size == 1:
            cells[int(kind)] = first + corners[begins[which][:, None] + numpy.arange(lengths[which][0])].astype(int)
    return cells


def joined(several):
    """Arrays that all pieces have, one behind the other."""
    names = set.intersection(*(set(each) for each in several)) if several else set()
    return {name: numpy.concatenate([each[name] for each in several]) for name in sorted(names)}


def read(path):
    """The mesh of a .vtu file, all pieces together. Throws OSError, ValueError, KeyError or ParseError."""
    points, cells, fields, n_points = [], {}, [], 0
    for piece in xml.etree.ElementTree.parse(path).iter("Piece"):
        if int(piece.get("NumberOfPoints", "0")) == 0:
            continue
        for kind, corners in cells_of(piece, n_points).items():
            cells.setdefault(kind, []).append(corners)
        points.append(shaped(piece.find("Points").find("DataArray")))
        fields.append(named(piece, "PointData"))
        n_points += len(points[-1])
    return Mesh(numpy.concatenate(points) if points else numpy.zeros((0, 3)),
                {kind: numpy.concatenate(each) for kind, each in cells.items()}, joined(fields))


def times(folder):
    """{time [s]: {name of the part: path}} of solution.pvd, in order; empty without it. Throws ParseError, ValueError."""
    path = os.path.join(folder, "solution.pvd")
    found = {}
    if os.path.exists(path):
        for each in xml.etree.ElementTree.parse(path).iter("DataSet"):
            name = each.get("name") or os.path.basename(each.get("file")).rsplit("_", 1)[0]
            found.setdefault(float(each.get("timestep")), {})[name] = os.path.join(folder, each.get("file"))
    return dict(sorted(found.items()))
