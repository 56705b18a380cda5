# SPDX-License-Identifier: LGPL-2.1-or-later
"""What stands first about a run: its extent, its cost and its main settings, as pairs of a name and a text."""
import os
import time

from study.description import flat

SETTINGS = (("scheme", "Scheme"), ("step", "Time/Step"), ("tolerance of steps", "Time/Tolerance"),
            ("integrator", "Time/Integrator"), ("cells of the fluid", "Domain/Cells"), ("spacing", "Particles/Spacing"))


def number(value):
    """A count with spaces between thousands, or four digits."""
    return f"{value:,.0f}".replace(",", "\u202f") if float(value).is_integer() else f"{value:.4g}"


def seconds(value):
    if value < 100:
        return f"{value:.3g} s"
    return f"{value / 60:.3g} min" if value < 6000 else f"{value / 3600:.3g} h"


def memory(value):
    for unit in ("B", "kB", "MB"):
        if value < 1000:
            return f"{value:.3g} {unit}"
        value /= 1000
    return f"{value:.3g} GB"


def short(text):
    """Six digits of a number that has more."""
    try:
        return f"{float(text):.6g}"
    except ValueError:
        return text


def extent(results):
    summary, table = results.summary, results.statistics
    rows = []
    reached = table.column("Time")[-1] if len(table) and "Time" in table else summary.get("time [s]")
    if reached is not None:
        end = summary.get("end [s]")
        rows.append(("time", f"{reached:.6g}" + (f" of {end:.6g} s" if end is not None else " s")))
    if len(table) and "Step" in table:
        cuts = summary.get("step cuts", 0)
        rows.append(("steps", number(table.column("Step")[-1]) + (f", cut {number(cuts)} times" if cuts else "")))
    unknowns = summary.get("unknowns", {})
    if unknowns:
        rows.append(("unknowns", ", ".join(f"{number(count)} {name}" for name, count in unknowns.items())))
    return rows


def cost(results):
    summary, rows = results.summary, []
    costs, steps = summary.get("cost", {}), summary.get("steps", 0)
    if summary.get("begin [s]", 0) > 0:
        rows.append(("since", f"{summary['begin [s]']:.6g} s, where the run was taken up again"))
    wall = costs.get("wall seconds")
    if wall is not None:
        each = f", {seconds(wall / steps)} a step" if steps else ""
        rows.append(("wall time", f"{seconds(wall)} on {summary.get('ranks', 1)} rank(s){each}"))
    if "core seconds" in costs:
        rows.append(("core time", f"{seconds(costs['core seconds'])}, and {seconds(costs.get('core seconds of the start', 0))} "
                     "of the start"))
    if "peak memory [bytes]" in costs:
        rows.append(("peak memory", memory(costs["peak memory [bytes]"])))
    for name in ("Newton iterations", "linear iterations"):
        if summary.get(name):
            rows.append((name, number(summary[name]) + (f", {summary[name] / steps:.3g} a step" if steps else "")))
    return rows


def settings(results):
    values = flat(results.parameters)
    return [(name, short(str(values[key]))) for name, key in SETTINGS if values.get(key, "") not in ("", "0")]


def written(results):
    """When the run has last written a row."""
    if not results.has("statistics"):
        return []
    changed = time.localtime(os.path.getmtime(results.path("statistics")))
    return [("last step made", time.strftime("%Y-%m-%d %H:%M", changed))]


def of_run(results):
    program = results.summary.get("program")
    return (extent(results) + cost(results) + settings(results) + ([("program", program)] if program else []) + written(results))
