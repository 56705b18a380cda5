# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of several runs: verdicts side by side, what they differ in, and their curves over each other."""
import os

from markupsafe import Markup

from report import facts, figure, parameters, plots, scene_picture, template, thinning, verdict
from report.template import PlotOfPage, Section

LINES = ("solid", "dashed", "dotted", "dash-dotted")


def names_of(folders):
    """The shortest ends of the paths that tell them apart."""
    paths = [os.path.abspath(folder).split(os.sep) for folder in folders]
    for length in range(1, max(map(len, paths)) + 1):
        names = [os.sep.join(path[-length:]) for path in paths]
        if len(set(names)) == len(names):
            return names
    return [f"{path[-1]} ({number})" for number, path in enumerate(paths, 1)]


def common_plots(runs):
    """Plots of the columns of all runs, each column once; stacks of several runs would hide each other, so they are lines."""
    found = {}
    for results in runs:
        for plot in plots.of_table(results.statistics, results.probes())[0]:
            into = found.setdefault((plot.section, plot.title, plot.unit), plots.Plot(plot.section, plot.title, plot.unit, [], [],
                                                                                      plot.kind, plot.first))
            for name, label in zip(plot.names, plot.labels):
                if name not in into.names:
                    into.names.append(name)
                    into.labels.append(label)
    return sorted(found.values(), key=lambda plot: (plots.SECTIONS.index(plot.section), plot.title != "Energies"))


def figure_of(plot, runs, names, identifier, most_rows):
    curves = []
    for group, (results, run) in enumerate(zip(runs, names)):
        table = results.statistics
        times = table.column("Time")[plot.first:] if "Time" in table else None
        for style, (name, label) in enumerate(zip(plot.names, plot.labels)):
            if name in table and times is not None:
                several = len(plot.names) > 1
                curves.append(figure.Curve(f"{run}, {label}" if several else run, times, plot.values(table, name), group, style))
    kind = "sums" if plot.kind == "stack" else plot.kind
    svg, data = figure.draw(curves, plot.unit, kind, identifier, most_rows)
    styles = ", ".join(f"{LINES[k % len(LINES)]}: {label}" for k, label in enumerate(plot.labels)) if len(plot.labels) > 1 else ""
    return PlotOfPage(identifier, plot.title + (f" ({styles})" if styles else ""), plot.unit, Markup(svg), data)


def sections_of_plots(runs, names):
    found = {}
    most_rows = thinning.most_rows(sum(len(results.statistics.names) for results in runs))
    for number, plot in enumerate(common_plots(runs)[:plots.MOST_PLOTS]):
        section = found.setdefault(plot.section, Section(plot.section))
        section.figures.append(figure_of(plot, runs, names, f"plot{number}", most_rows))
    return list(found.values())


def side_by_side(rows_of_runs):
    """Rows of a table of what each run has under the same name."""
    names = dict.fromkeys(name for rows in rows_of_runs for name, _ in rows)
    return [[name, *(dict(rows).get(name, "") for rows in rows_of_runs)] for name in names]


def write(runs):
    """HTML about several runs (Results)."""
    names = names_of([results.folder for results in runs])
    differing = [[name, *values] for name, values in parameters.differing(
        [results.parameters for results in runs])]
    described = [{"name": name, "colour": figure.COLOURS[k % len(figure.COLOURS)], "verdict": verdict.of_any(results),
                  "picture": scene_picture.of_run(results)[0], "problems": list(dict.fromkeys(results.problems))}
                 for k, (results, name) in enumerate(zip(runs, names))]
    remark = "" if differing else "None: all parameters are the same."
    sections = [Section("Verdicts"), Section("Parameters that differ", "parameters", remark), Section("Extent and cost", "facts"),
                *sections_of_plots(runs, names)]
    return template.page("comparison.html", sections, title="Comparison of " + " and ".join(names) if len(names) < 4 else
                         f"Comparison of {len(names)} runs", subtitle=", ".join(results.title() for results in runs), runs=described,
                         names=names, facts=side_by_side([results.attempt("summary.json", facts.of_run, []) for results in runs]), differing=differing,
                         refresh=0, frames=[], footer="Written by 'undine report' from the files in the folders alone.")
