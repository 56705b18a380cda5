# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of a study."""
import csv
import io
import math
import os

import numpy

from study import columns, convergence
from study.cases import variant, variant_name
from study.runs import reason


MOST_COLUMNS = 12  # of runs, in a table of phases
LEAST_SECONDS = 0.001  # of a phase that is listed


def row(cells):
    return "| " + " | ".join(str(cell).replace("|", r"\|") for cell in cells) + " |"


def table(head, rows):
    return [row(head), "|---" * len(head) + "|"] + [row(cells) for cells in rows] + [""]


def percent(value):
    """A relative error with two digits: "2.3 %"."""
    if math.isnan(value):
        return ""
    if math.isinf(value):
        return "unknown"
    if value != 0 and not 1e-7 < value < 100:
        return f"{100 * value:.1e} %"
    return f"{numpy.format_float_positional(100 * value, 2, fractional=False, trim='-')} %"


def number(value, form=".2f"):
    return "" if value is None or math.isnan(value) else format(value, form)


def settings(found, case):
    """The names of its values."""
    return [variation.names[position] for variation, position in zip(found.study.variations, case.index)]


def value_of(result, case):
    """The value of a scalar."""
    return f"{result.values[case].flat[0]:.6g}"


def errors(found, result):
    """A row for each run; the fronts' ones are bold."""
    front = found.front(result)
    rows = []
    for case in sorted(found.results, key=lambda case: case.index):
        cells = settings(found, case)
        if case in result.errors:
            error = "is the reference" if result.made_reference(case) else percent(result.errors[case])
            bold = f"**{error}**" if case in front else error
            cells += [value_of(result, case), bold] if result.is_scalar() else [bold, percent(result.largest[case])]
            cells.append(f"{found.cost(case):.3g}")
        else:
            why = "left out" if found.results[case].get("left out") else brief(found.results[case])
            cells += ["", why or result.missing.get(case, ""), ""]
        rows.append(cells)
    unit = f" [{result.quantity.unit}]" if result.quantity.unit else ""
    measures = ["value" + unit, "error"] if result.is_scalar() else ["error", "largest difference"]
    return table([variation.name for variation in found.study.variations] + measures + [found.study.cost], rows)


def brief(result):
    """Where a run has stopped, or why; "" if it has not failed."""
    stopped = result["failure"] and "reached" in result
    return f"stops at {result['reached']:.3g} s" if stopped else reason(result)


def orders(found, result):
    rows = []
    for base, axis, own, against in found.orders(result):
        others = [f"{variation.name} {variation.names[position]}" for k, (variation, position) in enumerate(
            zip(found.study.variations, base.index)) if k != axis]
        chance = own > convergence.LARGEST_ORDER
        rows.append([found.study.variations[axis].name, ", ".join(others),
                     f"> {convergence.LARGEST_ORDER}" if chance else number(own), number(against)])
    if not rows:
        return []
    return ["Observed orders of convergence (own: by differences of the last three values):", ""] + table(
        ["refined", "with", "own order", "order of the error"], rows)


def shares(each):
    return ", ".join(f"{share.name} {percent(share.size)}" for share in each)


def advice(found, result):
    if found.study.combine != "all":  # what is not refined together cannot be recommended together
        return []
    rows = []
    for each in found.advice(result):
        if each.case:
            rows.append([percent(each.level), *settings(found, each.case), percent(result.errors[each.case]),
                         f"{found.cost(each.case):.3g}", shares(each.shares)])
    if not rows:
        return ["No run is accurate enough for any of the levels, and all finer ones, too.", ""]
    lines = ["Cheapest settings for an error that all finer settings keep, too:", ""] + table(
        ["error at most", *(variation.name for variation in found.study.variations), "error", found.study.cost,
         "moved by refining"], rows)
    missing = sum(found.n_missing_finer(result, each.case) > 0 for each in found.advice(result) if each.case)
    if missing:
        lines += ["Of these settings, some finer ones have no value: whether they keep the error is not known.", ""]
    price = found.price_of_a_digit(result)
    if not math.isnan(price):
        lines += [f"A tenth of the error costs about {price:.3g} times as much.", ""]
    return lines


def variants(found, result):
    """What each variant costs for each level."""
    keys = list(dict.fromkeys(variant(found.study, case) for case in found.results))
    if found.study.combine != "all" or len(keys) < 2:
        return []
    levels, rows = sorted(found.study.levels, reverse=True), []
    for key in keys:
        cells = []
        for level in levels:
            case = found.cheapest(result, key, level)
            names = [settings(found, case)[axis] for axis in found.study.refinements()] if case else []
            cells.append(f"{found.cost(case):.3g} ({', '.join(names)})" if case else "")
        rows.append([variant_name(found.study, key), *cells])
    return [f"{found.study.cost.capitalize()} of each for an error that all finer settings keep, too, and its settings:",
            ""] + table(["", *map(percent, levels)], rows)


def budget(found, result):
    """How much of the error of the first values comes from what, if one thing at a time was refined."""
    if found.study.combine == "all":
        return []
    lines = []
    for base in found.bases(result):
        name = variant_name(found.study, variant(found.study, base))
        rows = [[share.name, percent(share.size), percent(share.uncertainty), share.remark]
                for share in found.budget(result, base)]
        lines += [f"Budget of the error of the first values ({name}):", ""] + table(
            ["refined alone", "moves the value by", "uncertain by", "remark"], rows)
    return lines


def section(found, result):
    """All about a quantity, as lines of Markdown."""
    reference = result.reference
    lines = [f"## {result.quantity.name}", ""]
    value = f"{reference.values.flat[0]:.6g}, " if result.is_scalar() else ""
    sure = f", uncertain by {percent(result.uncertainty())}" if reference.uncertainty else ""
    lines += [f"Reference: {value}{reference.source}{sure}. Bold: no other run is both cheaper and more accurate.", ""]
    lines += [f"Warning: {warning}." for warning in reference.warnings] + ([""] if reference.warnings else [])
    return lines + errors(found, result) + orders(found, result) + budget(found, result) + variants(found, result) + advice(
        found, result)


def costs(found):
    """What each run took."""
    rows = []
    for case in sorted(found.results, key=lambda case: case.index):
        result = found.results[case]
        if result.get("steps"):
            rows.append([*settings(found, case), result["unknowns"], result["steps"], result["Newton iterations"],
                         result["linear iterations"], f"{result['core seconds']:.3g}", f"{result['wall seconds']:.3g}",
                         f"{result['memory'] / 1e6:.0f}"])
    head = [variation.name for variation in found.study.variations] + [
        "unknowns", "steps", "Newton iterations", "linear iterations", "core seconds", "wall seconds", "memory [MB]"]
    return ["## Costs", ""] + table(head, rows) if rows else []


def phases(found):
    """Seconds of a step, or of the start, on each rank by phase, if not too many runs are to be compared."""
    cases = [case for case in sorted(found.results, key=lambda case: case.index) if found.results[case].get("steps")]
    seconds = [columns.phases(os.path.join(found.folders[case], "timing")) for case in cases]
    if not any(seconds) or len(cases) > MOST_COLUMNS:
        return []
    rows = []
    for name in dict.fromkeys(name for each in seconds for name in each):
        cells = [each.get(name, 0) / (1 if name.startswith("initialise") else found.results[case]["steps"])
                 for case, each in zip(cases, seconds)]
        if max(cells) >= LEAST_SECONDS:
            rows.append([name, *(f"{cell:.3f}" for cell in cells)])
    steps = [sum(value for name, value in each.items() if " / " not in name and name != "initialise") /
             found.results[case]["steps"] for case, each in zip(cases, seconds)]
    return ["## Wall seconds of a step by phase", "", "`initialise`: once.", ""] + table(
        ["phase", *(", ".join(settings(found, case)) for case in cases)],
        rows + [["**a step**", *(f"{cell:.3f}" for cell in steps)]])


def failures(found):
    """Each reason once, with the runs that it holds for."""
    reasons = {}
    for case in found.failures():
        at = brief(found.results[case]) if "reached" in found.results[case] else ""
        reasons.setdefault(reason(found.results[case]), []).append(case.name(found.study) + (f" ({at})" if at else ""))
    lines = [f"- {'all runs' if len(names) == len(found.results) else '; '.join(names)}: {why}"
             for why, names in reasons.items()]
    return ["## Runs without a result", "", *lines, ""] if lines else []


def records(found):
    """A dictionary for each run."""
    rows = []
    for case, outcome in sorted(found.results.items(), key=lambda item: item[0].index):
        cells = {variation.name: name for variation, name in zip(found.study.variations, settings(found, case))}
        for result in found.quantities:
            if result.is_scalar():
                unit = f" [{result.quantity.unit}]" if result.quantity.unit else ""
                cells[result.quantity.name + unit] = result.values[case].flat[0] if case in result.values else ""
            known = case in result.errors and not result.made_reference(case)
            cells[f"error of {result.quantity.name}"] = result.errors[case] if known else ""
        cells.update({f"run: {key}{unit}": outcome.get(key, "") for key, unit in (
            ("core seconds", ""), ("wall seconds", ""), ("memory", " [B]"), ("unknowns", ""), ("steps", ""),
            ("Newton iterations", ""), ("linear iterations", ""))})
        cells["failure"] = reason(outcome)
        rows.append(cells)
    return rows


def csv_of(found):
    stream, rows = io.StringIO(), records(found)
    writer = csv.DictWriter(stream, rows[0], lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return stream.getvalue()


def escaped(text):
    """For LaTeX."""
    others = {"\\": r"\textbackslash{}", "^": r"\textasciicircum{}", "~": r"\textasciitilde{}"}
    return "".join("\\" + sign if sign in "&%$#_{}" else others.get(sign, sign) for sign in text)


def latex_of(found):
    """A table of errors for each quantity."""
    lines = []
    for result in found.quantities:
        head = [variation.name for variation in found.study.variations] + ["relative error", found.study.cost]
        lines += [f"% {result.quantity.name}", "\\begin{tabular}{" + "l" * (len(head) - 2) + "rr}", "\\hline",
                  " & ".join(map(escaped, head)) + " \\\\", "\\hline"]
        lines += [" & ".join([*map(escaped, settings(found, case)),
                              "reference" if result.made_reference(case) else f"{result.errors[case]:.2e}",
                              f"{found.cost(case):.3g}"]) + " \\\\"
                  for case in sorted(result.errors, key=lambda case: case.index)]
        lines += ["\\hline", "\\end{tabular}", ""]
    return "\n".join(lines)


def finite(value):
    """For JSON."""
    return value if math.isfinite(value) else None


def data_of(found):
    """For other programs."""
    return {"title": found.study.title, "cost": found.study.cost, "runs": records(found), "quantities": [
        {"name": result.quantity.name, "orders": [
            {"refined": found.study.variations[axis].name, "from": base.settings(found.study), "own": finite(own),
             "of the error": finite(against)} for base, axis, own, against in found.orders(result)],
         "budget": [{"from": base.settings(found.study), "refined": share.name, "moves by": finite(share.size),
                     "uncertain by": finite(share.uncertainty), "remark": share.remark}
                    for base in found.bases(result) for share in found.budget(result, base)],
         "reference": result.reference.values.ravel().tolist(),
         "from": result.reference.source, "uncertainty": finite(result.uncertainty()), "warnings": result.reference.warnings,
         "advice": [{"error at most": each.level, "settings": each.case.settings(found.study),
                     "error": result.errors[each.case], "cost": found.cost(each.case)}
                    for each in (found.advice(result) if found.study.combine == "all" else []) if each.case]}
        for result in found.quantities]}
