# SPDX-License-Identifier: LGPL-2.1-or-later
"""Work-precision diagrams."""
import math
import textwrap

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # noqa: E402

from study.cases import variant, variant_name  # noqa: E402
from study.page import plain  # noqa: E402

STYLES = ("-", "--", ":", "-.")
MARKERS = "os^Dvp*Xh<>"


def curves(found, result):
    """[(variant, positions of all refinements but the last, cases along that last one)]."""
    refinements = found.study.refinements()
    last = refinements[-1:]
    groups = {}
    for case in sorted((case for case in result.errors if not result.made_reference(case)), key=lambda case: case.index):
        others = tuple(case.index[axis] for axis in refinements if axis not in last)
        groups.setdefault((variant(found.study, case), others), []).append(case)
    return [(key, others, group) for (key, others), group in groups.items()]


def label(found, key, others, several_variants):
    refinements = found.study.refinements()[:-1]
    words = [variant_name(found.study, key)] if several_variants or not refinements else []
    words += [f"{found.study.variations[axis].name} {found.study.variations[axis].names[position]}"
              for axis, position in zip(refinements, others)]
    return ", ".join(words)


def ordered(values):
    return list(dict.fromkeys(values))


def draw_curves(axes, found, result):
    lines = curves(found, result)
    # The same colour and style in every diagram, also in one where all runs of another variant have failed.
    cases, axes_but_one = sorted(found.results, key=lambda case: case.index), found.study.refinements()[:-1]
    variants = ordered(variant(found.study, case) for case in cases)
    groups = ordered(tuple(case.index[axis] for axis in axes_but_one) for case in cases)
    several = len(variants) > 1
    for key, others, cases in lines:
        colour = variants.index(key) if several else groups.index(others)
        style = STYLES[groups.index(others) % len(STYLES)] if several else "-"
        axes.plot([found.cost(case) for case in cases], [max(result.errors[case], 1e-16) for case in cases], style,
                  color=f"C{colour % 10}", marker=MARKERS[groups.index(others) % len(MARKERS)], markersize=4.5,
                  linewidth=1.1, label=plain(label(found, key, others, several)))


def draw_front(axes, found, result):
    front = found.front(result)
    axes.plot([found.cost(case) for case in front], [max(result.errors[case], 1e-16) for case in front], "o",
              markersize=10, markerfacecolor="none", markeredgecolor="black", markeredgewidth=0.9,
              label="none is cheaper and more accurate")
    for axis in found.study.refinements()[-1:]:
        for case in front:
            axes.annotate(found.study.variations[axis].names[case.index[axis]],
                          (found.cost(case), max(result.errors[case], 1e-16)), xytext=(6, 5), textcoords="offset points",
                          fontsize=7)
    if 0 < result.uncertainty() < math.inf:
        axes.axhline(result.uncertainty(), color="grey", linestyle="-.", linewidth=0.8,
                     label="uncertainty of the reference")


def minor_labels(axis, text):
    """Numbers between powers of ten where there are few of these, thinned out so that they do not meet."""
    low, high = axis.get_view_interval()
    if high >= 50 * low:
        return ticker.NullFormatter()
    shown = "123456789" if high < 5 * low else "235"
    return ticker.FuncFormatter(lambda value, _: text(value) if f"{value:e}"[0] in shown else "")


def style(axes):
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis, text in ((axes.xaxis, lambda value: f"{value:g}"), (axes.yaxis, lambda value: f"{100 * value:g} %")):
        axis.set_minor_formatter(minor_labels(axis, text))
        axis.set_major_formatter(ticker.FuncFormatter(lambda value, _, text=text: text(value)))
    axes.grid(alpha=0.3, which="both", linewidth=0.4)


def cost_label(found):
    refined = found.study.refinements()
    return f"{found.study.cost} of a run" + (
        f" (along a curve: {found.study.variations[refined[-1]].name})" if refined else "")


def draw(axes, found, result):
    """All of a diagram but its labels."""
    draw_curves(axes, found, result)
    draw_front(axes, found, result)
    style(axes)


def save(figure, path):
    figure.tight_layout()
    figure.savefig(path, dpi=100)
    pyplot.close(figure)


def work_precision(found, result, path):
    """Relative error over cost, a curve for each variant and each value of all refinements but the last."""
    figure, axes = pyplot.subplots(figsize=(8.6, 4.6))
    draw(axes, found, result)
    axes.set_xlabel(cost_label(found))
    axes.set_ylabel(plain(f"relative error of {result.quantity.name}"))
    axes.set_title(plain(found.study.title), fontsize=11)
    axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.01, 0.5))
    save(figure, path)


def missing_runs(found, result):
    """Of each variant that has not a single run in a diagram: a line that says so."""
    there = {variant(found.study, case) for case in result.errors}
    every = ordered(variant(found.study, case) for case in found.results)
    return [f"{variant_name(found.study, key)}: no run has succeeded" for key in every if key not in there]


def side_by_side(several, path):
    """The diagrams of the first quantities of several studies beside each other, with one legend of all their curves."""
    figure, panels = pyplot.subplots(1, len(several), figsize=(4.3 * len(several), 5.4), squeeze=False)
    legend = {}
    for axes, found in zip(panels[0], several):
        result = found.quantities[0]
        draw(axes, found, result)
        axes.set_title(plain("\n".join(textwrap.wrap(found.study.title, 34))), fontsize=10)
        axes.set_xlabel(cost_label(found), fontsize=9)
        axes.set_ylabel(plain(f"relative error of {result.quantity.name}"), fontsize=9)
        axes.text(0.02, 0.02, plain("\n".join(missing_runs(found, result))), transform=axes.transAxes, fontsize=8, color="C3")
        for line, name in zip(*axes.get_legend_handles_labels()):
            legend.setdefault(name, line)
    figure.tight_layout(rect=(0, 0.1, 1, 1))
    figure.legend(legend.values(), legend.keys(), loc="lower center", ncol=min(5, len(legend)), fontsize=9)
    figure.savefig(path, dpi=100)
    pyplot.close(figure)
