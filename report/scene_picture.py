# SPDX-License-Identifier: LGPL-2.1-or-later
"""A quick drawing of a run's first and last output: domain, fluid, bodies, obstacles, particles. contrib/render makes better ones."""
import base64
import io
import os
import xml.etree.ElementTree
import zlib

import matplotlib
import numpy
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from report import shapes, vtu
from study.page import plain

MOST_BYTES = 60_000_000  # of the files of one time: a larger solution takes too long
MOST_POLYGONS = 60_000  # of the fluid in a plane; finer grids are drawn by pixels
MOST_PARTICLES = 60_000
NOT_CARRIED = ("velocity", "pressure", "vorticity_magnitude", "component", "fluid_fraction")
BODY, OBSTACLE, WALL = "#e07b39", "#8a8f98", "#9aa0a8"
UNREADABLE = (OSError, ValueError, LookupError, TypeError, AttributeError, zlib.error, xml.etree.ElementTree.ParseError)


class Moment:
    """The parts of a solution at one time, bodies where they are then."""

    def __init__(self, time, files, moved):
        self.time = time
        if sum(os.path.getsize(file) for file in files.values()) > MOST_BYTES:
            raise ValueError(f"the solution at {time:g} s is too large to be drawn quickly; contrib/render draws it")
        self.parts = {name: vtu.read(file) for name, file in files.items() if name != "surface"}
        self.parts = {name: part for name, part in self.parts.items() if len(part.points)}
        bodies = self.parts.get("bodies")
        self.rest = bodies.points if bodies else None
        if bodies and not moved:
            bodies.points = bodies.points + three(bodies.fields["displacement"])

    def field(self):
        """(what is coloured, name and unit of its field, whether it is carried by the fluid); nothing if there is nothing."""
        if "fluid" in self.parts:
            carried = [name for name, values in self.parts["fluid"].fields.items()
                       if name not in NOT_CARRIED and values.shape[1] == 1]
            for name in sorted(carried, key=lambda name: name not in ("smoke", "temperature")):
                return "fluid", name, name, True
            return "fluid", "velocity", "speed of the fluid [m/s]", False
        if "particles" in self.parts:
            return "particles", "velocity", "speed [m/s]", False
        if "bodies" in self.parts:
            return "bodies", "displacement", "displacement [m]", False
        return None

    def values(self, part, name):
        """A number for each point: of vectors their length."""
        values = self.parts[part].fields[name]
        return numpy.linalg.norm(values, axis=1) if values.shape[1] > 1 else values[:, 0]

    def coloured_values(self, part, name):
        """The same without particles of bodies and walls, which have colours of their own."""
        values = self.values(part, name)
        return values[self.parts[part].fields["kind"][:, 0] == 0] if part == "particles" else values


def three(vectors):
    """Vectors with a third component."""
    return numpy.pad(vectors, ((0, 0), (0, 3 - vectors.shape[1])))


def whole(moment):
    """Cells of the fluid (n, corners) that are not all in bodies."""
    mesh = moment.parts["fluid"]
    cells = numpy.concatenate(shapes.cells_of(mesh))
    if "fluid_fraction" in mesh.fields:
        cells = cells[mesh.fields["fluid_fraction"][cells, 0].mean(axis=1) > 1e-9]
    return cells


def by_pixels(flat, values, weights=None):
    """On a raster, whose rows go upwards, means of values at places (n, 2), of which it has about two a pixel; or sums with
    weights, of about ten places."""
    low, high = flat.min(axis=0), flat.max(axis=0)
    extent = numpy.maximum(high - low, 1e-12)
    across = max(8, min(400, int(numpy.sqrt(len(flat) * extent[0] / extent[1] / (2 if weights is None else 10)))))
    along = max(8, min(400, int(across * extent[1] / extent[0])))
    bins, frame = [along, across], [[low[1], high[1]], [low[0], high[0]]]
    amount, _, _ = numpy.histogram2d(flat[:, 1], flat[:, 0], bins, frame, weights=values if weights is None else values * weights)
    if weights is None:
        number, _, _ = numpy.histogram2d(flat[:, 1], flat[:, 0], bins, frame)
        amount = numpy.where(number > 0, amount / numpy.maximum(number, 1), numpy.nan)
    return amount, (low[0], high[0], low[1], high[1])


class Painter:
    """Draws moments with the same view, limits and colours."""

    def __init__(self, moments, dimension):
        self.view, self.dimension = shapes.View(dimension), dimension
        self.coloured = moments[-1].field()
        corners = numpy.concatenate([self.view.flat(part.points) for moment in moments for part in moment.parts.values()])
        self.low, self.high = corners.min(axis=0), corners.max(axis=0)
        self.norm, self.colours = None, matplotlib.colormaps["viridis"]
        if self.coloured:
            part, field, _, carried = self.coloured
            values = numpy.concatenate([[0.0], *(moment.coloured_values(part, field) for moment in moments if part in moment.parts)])
            low = float(values[1:].min()) if carried else 0.0
            self.norm = Normalize(low, float(values.max()))
            self.colours = matplotlib.colormaps["magma_r" if carried else "viridis"]
            if part != "fluid" and not values.max() > low:
                self.coloured = None  # nothing has moved

    def paint(self, axes, moment):
        if "fluid" in moment.parts:
            self.paint_fluid(axes, moment)
        for name, colour in (("obstacles", OBSTACLE), ("bodies", BODY)):
            if name in moment.parts:
                self.paint_surface(axes, moment, name, colour)
        if "particles" in moment.parts:
            self.paint_particles(axes, moment)
        margin = 0.02 * (self.high - self.low).max()
        axes.set_xlim(self.low[0] - margin, self.high[0] + margin)
        axes.set_ylim(self.low[1] - margin, self.high[1] + margin)
        axes.set_aspect("equal")
        axes.set_title(f"t = {moment.time:.4g} s", fontsize=9, loc="left", pad=3)
        if self.dimension == 3:
            axes.set_axis_off()
        else:
            axes.tick_params(labelsize=7, length=2, colors="#444a52")
            for spine in axes.spines.values():
                spine.set(color="#c6ccd4", linewidth=0.6)
            axes.set_xlabel("x [m]", fontsize=7.5, labelpad=1)
            axes.set_ylabel("y [m]", fontsize=7.5, labelpad=1)

    def paint_fluid(self, axes, moment):
        mesh, values = moment.parts["fluid"], moment.values("fluid", self.coloured[1])
        cells = whole(moment)
        if self.dimension == 3:
            edges = self.view.flat(shapes.box_edges(mesh.points.min(axis=0), mesh.points.max(axis=0)))
            axes.add_collection(LineCollection(edges, colors="#b0b6be", linewidths=0.6))
        if self.dimension == 3 and self.coloured[3]:
            return self.paint_cloud(axes, mesh, cells, values)
        if self.dimension == 3:
            which, quads = shapes.slice_through_middle(mesh, cells)
            return self.add_polygons(axes, self.view.flat(quads), values[cells[which]].mean(axis=1), alpha=0.75)
        if len(cells) <= MOST_POLYGONS:
            return self.add_polygons(axes, self.view.flat(mesh.points[cells]), values[cells].mean(axis=1))
        raster, frame = by_pixels(self.view.flat(mesh.points[cells].mean(axis=1)), values[cells].mean(axis=1))
        axes.imshow(raster, origin="lower", extent=frame, norm=self.norm, cmap=self.colours, aspect="auto")

    def paint_cloud(self, axes, mesh, cells, values):
        """What is carried, as it adds up along the line of sight."""
        corners = mesh.points[cells]
        volumes = numpy.prod(numpy.ptp(corners, axis=1), axis=1)
        amount, frame = by_pixels(self.view.flat(corners.mean(axis=1)), values[cells].mean(axis=1) - self.norm.vmin, volumes)
        density = amount / max(amount.max(), 1e-300)
        shade = numpy.zeros(density.shape + (4,))
        shade[..., :3], shade[..., 3] = (0.25, 0.28, 0.35), 1 - numpy.exp(-3 * density)
        axes.imshow(shade, origin="lower", extent=frame, interpolation="bicubic", aspect="auto")

    def add_polygons(self, axes, polygons, values, alpha=1.0):
        axes.add_collection(PolyCollection(polygons, array=values, norm=self.norm, cmap=self.colours, alpha=alpha,
                                           antialiased=False, linewidths=0))

    def paint_surface(self, axes, moment, name, colour):
        mesh = moment.parts[name]
        is_coloured = self.coloured is not None and self.coloured[0] == name
        at_rest = vtu.Mesh(moment.rest if name == "bodies" else mesh.points, mesh.cells, mesh.fields)
        for faces in shapes.surface(at_rest, self.dimension):
            corners = mesh.points[faces]
            if faces.shape[1] == 2:
                axes.add_collection(LineCollection(self.view.flat(corners), colors="#444a52", linewidths=1.2))
                continue
            order = numpy.argsort(self.view.nearness(corners.mean(axis=1)))
            shade = self.colours(self.norm(moment.values(name, self.coloured[1])[faces].mean(axis=1))) if is_coloured else (
                numpy.tile(matplotlib.colors.to_rgba(colour), (len(faces), 1)))
            shade[:, :3] *= shapes.brightness(corners, self.dimension)[:, None]
            axes.add_collection(PolyCollection(self.view.flat(corners)[order], facecolors=shade[order], edgecolors=shade[order],
                                               linewidths=0.2))
        if self.dimension == 2 and name == "bodies":
            edges = self.view.flat(mesh.points[shapes.outline(at_rest)])
            axes.add_collection(LineCollection(edges, colors="#3a2412", linewidths=0.7))

    def paint_particles(self, axes, moment):
        mesh = moment.parts["particles"]
        kind = mesh.fields["kind"][:, 0]
        flat = self.view.flat(mesh.points)
        some = numpy.arange(0, len(flat), -(-len(flat) // MOST_PARTICLES))
        some = some[numpy.argsort(self.view.nearness(mesh.points[some]))]
        colours = self.colours(self.norm(moment.values("particles", "velocity")))
        colours[kind == 1], colours[kind > 1] = matplotlib.colors.to_rgba(BODY), matplotlib.colors.to_rgba(WALL)
        if self.dimension == 3:  # what is farther away is darker
            nearness = self.view.nearness(mesh.points)
            colours[:, :3] *= (0.55 + 0.45 * (nearness - nearness.min()) / max(numpy.ptp(nearness), 1e-12))[:, None]
        area = numpy.prod(self.high - self.low)
        density = len(some) ** (-0.5 if self.dimension == 2 else -0.38)
        size = (0.8 * density * numpy.sqrt(area) * self.points_per_metre(axes)) ** 2
        axes.scatter(*flat[some].T, s=min(max(size, 0.4), 40), c=colours[some], linewidths=0)

    def points_per_metre(self, axes):
        box = axes.get_window_extent()
        return min(box.width, box.height / ((self.high - self.low)[1] / (self.high - self.low)[0])) * 72 / (
            axes.figure.dpi * (self.high - self.low)[0])


def arranged(n, low, high):
    """A figure with axes for n pictures beside or below each other, and one for the colours."""
    width, height = high - low
    ratio = height / max(width, 1e-12)
    stacked = n == 1 or ratio < 0.45
    rows, across = (n, 1) if stacked else (1, n)
    panel = 6.6 / across
    tall = min(max(panel * ratio, 0.6), 4.2 / rows if stacked else 3.8) + 0.45
    figure = Figure(figsize=(6.8, rows * tall + 0.55), dpi=130)
    FigureCanvasAgg(figure)
    grid = figure.add_gridspec(rows + 1, across, height_ratios=[tall] * rows + [0.09], left=0.085, right=0.985, top=0.93,
                               bottom=0.5 / (rows * tall + 0.55), hspace=0.4, wspace=0.16)
    return figure, [figure.add_subplot(grid[k // across, k % across]) for k in range(n)], figure.add_subplot(grid[rows, :])


def draw(moments, dimension):
    """PNG."""
    painter = Painter(moments, dimension)
    figure, panels, bar = arranged(len(moments), painter.low, painter.high)
    for axes, moment in zip(panels, moments):
        painter.paint(axes, moment)
    if painter.coloured and not (dimension == 3 and painter.coloured[3]):
        colours = matplotlib.cm.ScalarMappable(painter.norm, painter.colours)
        figure.colorbar(colours, cax=bar, orientation="horizontal")
        bar.tick_params(labelsize=7, length=2)
        bar.set_xlabel(plain(painter.coloured[2]), fontsize=7.5, labelpad=1)
    else:
        bar.set_axis_off()
    stream = io.BytesIO()
    figure.savefig(stream, format="png")
    return stream.getvalue()


def of_run(results):
    """(data URI of a picture of the first and the last output, "") or ("", why there is none)."""
    try:
        times = vtu.times(results.folder)
        if not times:
            return "", "the folder holds no solution.pvd"
        moved = results.parameters.get("Output", {}).get("vtu", {}).get("Bodies") == "deformed"
        moments = [Moment(time, times[time], moved) for time in dict.fromkeys((min(times), max(times)))]
        if not any(moment.parts for moment in moments):
            return "", "the solution is empty"
        picture = draw(moments, results.dimension())
    except UNREADABLE as error:
        return "", f"the solution cannot be drawn: {error}"
    return "data:image/png;base64," + base64.b64encode(picture).decode(), ""
