# SPDX-License-Identifier: LGPL-2.1-or-later
"""Polygons and clouds that stand for the parts of a solution, seen from where contrib/render looks from."""
import numpy

TOWARDS_EYE = numpy.array([0.55, 0.4, 1.0])  # in three dimensions; y is up
KINDS = {9: 4, 70: 4, 12: 8, 72: 8, 5: 3, 3: 2}  # VTK's number of a kind of cells: its corners
FACES = {4: ((0, 1, 2, 3),), 3: ((0, 1, 2),), 2: ((0, 1),),
         8: ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))}
LIGHT = numpy.array([0.4, 0.8, 0.6])


class View:
    """From points in space to the plane of the picture, and how near they are to the eye."""

    def __init__(self, dimension):
        towards = TOWARDS_EYE / numpy.linalg.norm(TOWARDS_EYE) if dimension == 3 else numpy.array([0.0, 0.0, 1.0])
        right = numpy.cross([0.0, 1.0, 0.0], towards)
        right /= numpy.linalg.norm(right)
        self.axes = numpy.array([right, numpy.cross(towards, right)])
        self.towards = towards

    def flat(self, points):
        """(..., 3) to (..., 2)."""
        return points @ self.axes.T

    def nearness(self, points):
        return points @ self.towards


def cells_of(mesh):
    """Corners (cells, corners) of each kind of cells that there is."""
    return [corners[:, :KINDS[kind]] for kind, corners in mesh.cells.items() if kind in KINDS]


def merged(points):
    """A number for each point, the same for points at the same place."""
    extent = float(numpy.ptp(points, axis=0).max()) or 1.0
    _, numbers = numpy.unique(numpy.round(points / (1e-7 * extent)).astype(numpy.int64), axis=0, return_inverse=True)
    return numbers.ravel()


def surface(mesh, dimension):
    """Faces (faces, corners) of cells that have no neighbour there; in the plane, the cells themselves."""
    faces, numbers = [], merged(mesh.points)
    for cells in cells_of(mesh):
        own = numpy.concatenate([cells[:, list(face)] for face in FACES[cells.shape[1]]])
        if dimension == 3 and cells.shape[1] == 8:
            _, first, count = numpy.unique(numpy.sort(numbers[own], axis=1), axis=0, return_index=True, return_counts=True)
            own = own[first[count == 1]]
        faces.append(own)
    return faces


def outline(mesh):
    """Edges (edges, 2) of plane cells that have no neighbour there."""
    numbers, edges = merged(mesh.points), []
    for cells in cells_of(mesh):
        own = numpy.concatenate([numpy.column_stack([cells[:, k], cells[:, (k + 1) % cells.shape[1]]])
                                 for k in range(cells.shape[1])])
        _, first, count = numpy.unique(numpy.sort(numbers[own], axis=1), axis=0, return_index=True, return_counts=True)
        edges.append(own[first[count == 1]])
    return numpy.concatenate(edges) if edges else numpy.zeros((0, 2), dtype=int)


def brightness(corners, dimension):
    """Of faces (faces, corners, 3) under a light: 0.55 to 1, and 1 in the plane."""
    if dimension < 3:
        return numpy.ones(len(corners))
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = numpy.linalg.norm(normals, axis=1)
    cosine = numpy.abs(normals @ LIGHT) / (numpy.where(lengths > 0, lengths, 1) * numpy.linalg.norm(LIGHT))
    return 0.55 + 0.45 * cosine


def box_edges(low, high):
    """The twelve edges (12, 2, 3) of a box."""
    corners = numpy.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    return numpy.array([(corners[a], corners[b]) for a in range(8) for b in range(a + 1, 8)
                        if numpy.sum(numpy.array(list(f"{a:03b}")) != numpy.array(list(f"{b:03b}"))) == 1])


def slice_through_middle(mesh, cells):
    """Of cells (n, 8) that are boxes: which the plane through the middle cuts, across z, and their quadrilaterals there."""
    z = mesh.points[:, 2]
    middle = (z.min() + z.max()) / 2 + 1e-9 * (z.max() - z.min())
    low, high = z[cells].min(axis=1), z[cells].max(axis=1)
    which = numpy.flatnonzero((low <= middle) & (middle < high))
    box = mesh.points[cells[which]]
    least, most = box.min(axis=1), box.max(axis=1)
    x, y = (numpy.stack([least[:, a], most[:, a]], axis=1) for a in (0, 1))
    quads = numpy.stack([numpy.stack([x[:, i], y[:, j], numpy.full(len(x), middle)], axis=1)
                         for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))], axis=1)
    return which, quads
