# SPDX-License-Identifier: LGPL-2.1-or-later
"""A plot over time as SVG by Matplotlib, and the numbers that hover.js shows where the mouse is."""
import io
from dataclasses import dataclass

import matplotlib
import numpy
from matplotlib import ticker
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from report import thinning
from study.page import inline_svg, plain

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f3c8d", "#8c564b", "#555555", "#bcbd22",
           "#1f4e79", "#a63603", "#31a354", "#ad1457", "#997700", "#3182bd")
STYLES = ("-", "--", ":", "-.")
SIZE = (6.1, 2.55)  # inches
BOX = (0.115, 0.175, 0.865, 0.775)  # left, bottom, width, height of the axes, of the figure
DECADES = 1e3  # a number without a unit, above zero, that spans more has a logarithmic axis

matplotlib.rcParams.update({"svg.fonttype": "none", "font.size": 8.5, "font.family": "sans-serif", "path.simplify": True,
                            "axes.linewidth": 0.6, "font.sans-serif": ["DejaVu Sans"]})


@dataclass
class Curve:
    """`times` [s] and `values` as long; `group`: 0, 1, ... of the legend's colours, `style`: of the line."""
    name: str
    times: numpy.ndarray
    values: numpy.ndarray
    group: int = 0
    style: int = 0

    def colour(self):
        return COLOURS[self.group % len(COLOURS)]


def digits(values):
    """As numbers of JSON with ten digits, which is what files of Undine have."""
    return [float(f"{value:.9e}") for value in values]


def is_logarithmic(curves, unit, kind):
    """Residuals and the like: numbers above zero, but perhaps for the initial state, over many decades."""
    values = numpy.concatenate([curve.values for curve in curves])
    above = values[values > 0]
    return kind == "lines" and unit == "1" and above.size > 0 and values.min() >= 0 and (values <= 0).sum() <= len(curves) and (
        above.max() > DECADES * above.min())


def thinned(curves, most_rows):
    """The same with fewer points; curves at the same times stay at the same times."""
    result = []
    for times in {id(curve.times): curve.times for curve in curves}.values():
        together = [curve for curve in curves if curve.times is times]
        rows = thinning.rows_to_draw(numpy.column_stack([curve.values for curve in together]), most_rows)
        some = times[rows]
        result += [Curve(curve.name, some, curve.values[rows], curve.group, curve.style) for curve in together]
    return result


def draw_stack(axes, curves):
    """What is gained upwards, what is lost downwards, and the sum of both as a line."""
    for sign in (1, -1):
        below = numpy.zeros_like(curves[0].values)
        for number, curve in enumerate(curves):
            if curve.name == "gain":
                continue
            above = below + numpy.where(sign * curve.values > 0, curve.values, 0)
            axes.fill_between(curve.times, below, above, color=curve.colour(), linewidth=0, alpha=0.85,
                              gid=f"curve{number}{'ab'[sign < 0]}")
            below = above
    for number, curve in enumerate(curves):
        if curve.name == "gain":
            axes.plot(curve.times, curve.values, color="black", linewidth=1.4, gid=f"curve{number}")


def draw_lines(axes, curves, kind):
    for number, curve in enumerate(curves):
        axes.plot(curve.times, curve.values, STYLES[curve.style % len(STYLES)], color=curve.colour(), linewidth=1.1,
                  drawstyle="steps-mid" if kind == "steps" else "default", gid=f"curve{number}",
                  marker="." if len(curve.times) < 40 else "", markersize=4)


def style(axes, unit, kind, logarithmic):
    axes.set_xlabel("t [s]", labelpad=1)
    axes.set_ylabel("" if unit in ("", "1") else f"[{plain(unit)}]", labelpad=2)
    if logarithmic:
        axes.set_yscale("log")
    elif kind == "steps":
        axes.yaxis.set_major_locator(ticker.MaxNLocator(5, integer=True))
    else:
        axes.yaxis.set_major_locator(ticker.MaxNLocator(5))
        axes.ticklabel_format(axis="y", scilimits=(-3, 4))
    axes.xaxis.set_major_locator(ticker.MaxNLocator(7))
    axes.margins(x=0.01, y=0.08)
    axes.grid(alpha=0.35, linewidth=0.4)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def hover_data(axes, figure, curves, unit, kind):
    """Where the axes are in the picture, in its own units, and all points that are drawn."""
    width, height = figure.get_size_inches() * 72
    left, bottom, right, top = axes.get_position().extents
    times = list({id(curve.times): curve.times for curve in curves}.values())
    return {"box": [left * width, (1 - top) * height, (right - left) * width, (top - bottom) * height],
            "limits": [*axes.get_xlim(), *axes.get_ylim()], "logarithmic": axes.get_yscale() == "log",
            "unit": "" if unit == "1" else unit, "kind": kind, "times": [digits(each) for each in times],
            "curves": [{"name": curve.name, "colour": "#000000" if kind == "stack" and curve.name == "gain" else curve.colour(),
                        "times": next(k for k, each in enumerate(times) if each is curve.times),
                        "group": curve.group, "values": digits(curve.values)} for curve in curves]}


def draw(curves, unit, kind, identifier, most_rows=thinning.MOST_ROWS):
    """(SVG, data for hover.js) of curves. `identifier`: of this plot on its page."""
    curves = thinned(curves, most_rows)
    figure = Figure(figsize=SIZE)
    FigureCanvasSVG(figure)
    axes = figure.add_axes(BOX)
    if kind == "stack":
        draw_stack(axes, curves)
    else:
        draw_lines(axes, curves, kind)
    style(axes, unit, kind, is_logarithmic(curves, unit, kind))
    stream = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": identifier}):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    return inline_svg(stream.getvalue(), identifier), hover_data(axes, figure, curves, unit, kind)
