# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plots of what steps cost, as SVG and PNG."""
import math
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # noqa: E402

from study.plots import minor_labels  # noqa: E402

LEAST_SHARE = 0.03  # of a bar, of a part that has a colour of its own


def save(figure, path):
    for suffix in (".svg", ".png"):
        figure.savefig(path + suffix, dpi=110)
    pyplot.close(figure)


def axis_of_ranks(axes, ranks):
    axes.set_xscale("log", base=2)
    axes.set_xticks(ranks)
    axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_locator(ticker.NullLocator())
    axes.set_xlabel("ranks [1]")
    axes.grid(alpha=0.3, which="both", linewidth=0.4)


def scaling(kind, lines, path):
    """Seconds a step and efficiency over ranks, of {scene: {ranks: (seconds, efficiency)}}, with what would be ideal."""
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4.8))
    ranks = sorted({rank for line in lines.values() for rank in line})
    for number, (name, line) in enumerate(lines.items()):
        style = {"color": f"C{number}", "marker": "os^Dvp"[number % 6], "markersize": 5, "label": name}
        seconds, efficiency = zip(*line.values())
        left.plot(list(line), seconds, **style)
        right.plot(list(line), [100 * value for value in efficiency], **style)
        fewest = min(line)
        ideal = [line[fewest][0] * (fewest / rank if kind == "strong" else 1) for rank in line]
        left.plot(list(line), ideal, "--", color=f"C{number}", linewidth=0.9)
    left.plot([], [], "--", color="grey", linewidth=0.9, label="ideal")
    right.axhline(100, linestyle="--", color="grey", linewidth=0.9, label="ideal")
    left.set_yscale("log")
    left.yaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    left.yaxis.set_minor_formatter(minor_labels(left.yaxis, lambda value: f"{value:g}"))
    left.set_ylabel("wall time of a step [s]")
    right.set_ylim(0, max(110, right.get_ylim()[1]))
    right.set_ylabel("parallel efficiency [%]")
    for axes in (left, right):
        axis_of_ranks(axes, ranks)
    size = "the same cells on all ranks together" if kind == "strong" else "the same cells on each rank"
    figure.suptitle(f"{kind.capitalize()} scaling: {size}", fontsize=12)
    figure.tight_layout(rect=(0, 0.1, 1, 1))
    figure.legend(*left.get_legend_handles_labels(), loc="lower center", ncol=4, fontsize=9)
    save(figure, path)


def shown_parts(scenes):
    """Those that matter in some bar, the largest first."""
    shares = {}
    for bars in scenes.values():
        for parts in bars.values():
            for name, seconds in parts.items():
                shares[name] = max(shares.get(name, 0), seconds / max(1e-300, sum(parts.values())))
    return [name for name in sorted(shares, key=lambda name: -shares[name]) if shares[name] > LEAST_SHARE]


def stacked_bars(scenes, path):
    """Seconds of a step by parts: {scene: {variant: {part: seconds}}}, a panel for each scene."""
    if not scenes:
        sys.exit("cost_plots.py: no run has ended")
    columns = min(3, len(scenes))
    lines = math.ceil(len(scenes) / columns)
    most = max(map(len, scenes.values()))
    figure, panels = pyplot.subplots(lines, columns, figsize=(5 * columns, lines * (1.2 + 0.33 * most) + 0.8), squeeze=False)
    names = shown_parts(scenes)
    colours = {name: pyplot.get_cmap("tab20")(k % 20) for k, name in enumerate(names)}
    for axes, (scene, bars) in zip(panels.flat, scenes.items()):
        for place, parts in enumerate(bars.values()):
            left = 0
            for name in names:
                axes.barh(place, parts.get(name, 0), left=left, color=colours[name])
                left += parts.get(name, 0)
            axes.barh(place, max(0, sum(parts.values()) - left), left=left, color="lightgrey")
        axes.set_yticks(range(len(bars)), list(bars), fontsize=8)
        axes.invert_yaxis()
        axes.set_title(scene, fontsize=10)
        axes.set_xlabel("wall time of a step [s]", fontsize=9)
        axes.grid(axis="x", alpha=0.3, linewidth=0.4)
    for axes in panels.flat[len(scenes):]:
        axes.set_visible(False)
    handles = [pyplot.Rectangle((0, 0), 1, 1, color=colour) for colour in [*colours.values(), "lightgrey"]]
    bottom = 0.7 / figure.get_figheight()
    figure.tight_layout(rect=(0, bottom, 1, 1))
    figure.legend(handles, [*names, "all others"], loc="lower center", ncol=min(6, len(names) + 1), fontsize=8)
    save(figure, path)
