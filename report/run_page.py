# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of one run."""
import hashlib
import os
import shlex

from markupsafe import Markup

from report import facts, figure, frames, parameters, phases, plots, scene_picture, template, thinning, verdict
from report.template import PlotOfPage, Section

REFRESH = 60  # seconds between two looks of a browser at the page of a run that goes on
REMARKS = {"Ledger": "Added up since the first row of the file. Above zero: gained; below: lost; the black line: what there is more of. "
                     "Transport: carried by the flow; boundary values, sides: at the sides of the domain; interface: between fluid and "
                     "bodies; supports: what holds bodies; integrator: what the steps' rule adds or takes. Point at the plot for the sums, "
                     "click a name to hide it."}


def figure_of(plot, table, identifier, most_rows):
    times = table.column("Time")[plot.first:]
    curves = [figure.Curve(label, times, plot.values(table, name), k) for k, (name, label) in enumerate(zip(plot.names, plot.labels))]
    svg, data = figure.draw(curves, plot.unit, plot.kind, identifier, most_rows)
    return PlotOfPage(identifier, plot.title, plot.unit, Markup(svg), data)


def sections_of_plots(results, drawn):
    table, found = results.statistics, {}
    most_rows = thinning.most_rows(len(table.names))
    for number, plot in enumerate(drawn):
        section = found.setdefault(plot.section, Section(plot.section, remark=REMARKS.get(plot.section, "")))
        section.figures.append(figure_of(plot, table, f"plot{number}", most_rows))
    return found


def margins(results):
    def form(value):
        return "no number" if value is None else f"{value:.3g}"
    return [(each.get("law", ""), form(each.get("margin")), form(each.get("value")), form(each.get("bound")),
             each.get("meaning", "")) for each in results.summary.get("certificate", {}).get("margins", [])]


def errors(results):
    return [(each.get("kind", ""), "no number" if each.get("largest") is None else f"{each['largest']:.2g}",
             each.get("meaning", "")) for each in results.summary.get("errors", [])]


def error_remarks(results):
    remarks = []
    if not results.summary.get("time is estimated"):
        remarks.append("Nothing estimates the error in time: runs with shorter steps tell it, or Time / Tolerance.")
    remarks.append("The error of the grid, the elements or the spacing is not known to a single run: './undine SCENE.prm --accuracy "
                   "1%' estimates it by coarser runs, './undine study' measures it. All values are the largest in any step.")
    return remarks


def effects(results):
    """(rows of those that are on, names of those that are off)."""
    whole = results.effects.get("seconds", 0)
    rows, off = [], []
    for each in results.effects.get("effects", []):
        if not each.get("on"):
            off.append(each.get("name", ""))
            continue
        spent = each.get("seconds", 0)
        rows.append((each.get("name", ""), f"{spent:.3g}", f"{100 * spent / whole:.1f} %" if whole else "",
                     facts.memory(each.get("peak bytes", 0)), each.get("why", "")))
    return rows, off


def advice(results):
    lines = [f"{each['effect']} is {'on' if each['on'] else 'off'} and {'would matter' if each['matters'] else 'does not matter'}: "
             f"{each['number']} = {each['value']:.3g}; {each['rule']}" for each in results.effects.get("advice", [])]
    return lines


def effect_numbers(results):
    return [(each.get("name", ""), f"{each['value']:.4g}", each.get("meaning", "")) for each in results.effects.get("numbers", [])]


def citation(results):
    """In the form of BibTeX."""
    version, text = results.summary.get("program", "").partition(" ")[2], results.text("parameters.prm")
    lines = ["title   = {Undine: two-way coupling of incompressible fluids and deformable bodies}"]
    lines += [f"version = {{{version}}}"] if version else []
    lines += ["license = {LGPL-2.1-or-later}"]
    lines += [f"note    = {{parameters.prm of the run: SHA-256 {hashlib.sha256(text.encode()).hexdigest()}}}"] if text else []
    return "@software{undine,\n  " + ",\n  ".join(lines) + "\n}"


def commands(results, found):
    """(what for, command)."""
    folder = shlex.quote(results.folder)
    rows = []
    if results.has("checkpoint"):
        change = {"failed": ' --set "Time/Step=..."', "running": None}.get(found.word.split(",")[0], "")
        if results.summary.get("ended"):
            rows.append(("Go on to a later time:", f'./undine resume {folder} --set "Time/End=..."'))
        elif change is not None:
            rows.append(("Go on from the last checkpoint, on any number of ranks:", f"./undine resume {folder}{change}"))
    if results.has("parameters.prm"):
        rows.append(("Repeat the run with all its parameters:",
                     f"./undine {shlex.quote(results.path('parameters.prm'))} --output NEW"))
    if results.has("solution.pvd"):
        rows.append(("Make a film of it, which this page then shows, or frames alone, without --film:",
                     f"contrib/render {folder} --film\n./undine report {folder}"))
    rows.append(("Write this page again, or compare with another run:",
                 f"./undine report {folder}\n./undine report {folder} OTHER --out comparison.html"))
    return [*rows, ("Cite the program, and the very parameters:", citation(results))]


def subtitle(results):
    scene = os.path.basename(results.summary.get("scene", ""))
    return "Undine" + (f", scene {scene}" if scene else "") + f", results in {results.folder}"


def write(results):
    """HTML about a run."""
    found = verdict.of_any(results)
    drawn, constant, left_out = plots.of_table(results.statistics, results.probes())
    of_plots = sections_of_plots(results, drawn)
    picture, no_picture = scene_picture.of_run(results)
    film, embedded = frames.film_of(results)
    pictures, n_frames = ([], 0) if film else frames.of_run(results)
    on, off = results.attempt("effects.json", effects, ([], []))
    given = parameters.given(results.text("parameters.prm"))
    timing = phases.tree(results.path("timing"))
    units = dict(zip(results.statistics.names, results.statistics.units))
    others = of_plots.pop("Other columns", None)
    if others and left_out:
        others.remark = "Not drawn, for want of room: " + ", ".join(left_out) + "."
    sections = [Section("Frames", remark=f"{len(pictures)} of {n_frames} frames that contrib/render has made, reduced in size.")
                ] if pictures else []
    sections += [Section("Film", remark="What contrib/render has made." if embedded else
                         f"What contrib/render has made: the file {frames.FILM}, which must lie beside this page.")] if film else []
    sections += of_plots.values()
    sections += [Section("Stability and error", "stability")] if results.summary else []
    sections += [Section("Effects")] if results.effects else []
    sections += [Section("Seconds by phase", "seconds")] if timing else []
    sections += [Section("Parameters", remark="What the scene sets; everything else has its default, see parameters.prm.")
                 ] if given else []
    sections += [others] if others else []
    sections += [Section("Columns that never change", "constant")] if constant else []
    sections.append(Section("Repeat, resume, cite", "cite"))
    return template.page(
        "run.html", sections, title=results.title(), subtitle=results.attempt("summary.json", subtitle, results.folder), verdict=found, facts=results.attempt("summary.json", facts.of_run, []),
        picture=picture, no_picture=no_picture, frames=pictures, film=film, margins=results.attempt("summary.json", margins, []),
        errors=results.attempt("summary.json", errors, []),
        error_remarks=error_remarks(results), advice=results.attempt("effects.json", advice, []), effects_on=on, effects_off=off,
        effect_numbers=results.attempt("effects.json", effect_numbers, []), timing=timing, given=given,
        constant=[(name, f"{value:.6g}", units[name]) for name, value in constant.items()],
        commands=results.attempt("summary.json", lambda own: commands(own, found), []), problems=list(dict.fromkeys(results.problems)),
        refresh=REFRESH if results.is_running() else 0, footer="Written by 'undine report' from the files in the folder alone.")
