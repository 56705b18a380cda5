# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes what a study has found: tables as text, CSV and LaTeX, pictures, and a page that holds it all."""
import json
import os

from study import page, plots, tables
from study.cases import ranks


def write(found, folder):
    """All files; returns their paths."""
    files = {"study.md": text(found, pictures=True), "study.csv": tables.csv_of(found), "study.tex": tables.latex_of(found),
             "study.json": json.dumps(tables.data_of(found), indent=1, allow_nan=False)}
    pictures = {}
    for k, result in enumerate(found.quantities):
        name = f"work_precision_{k + 1}"
        for kind in ("svg", "png"):
            path = os.path.join(folder, f"{name}.{kind}")
            plots.work_precision(found, result, path)
        pictures[result.quantity.name] = os.path.join(folder, f"{name}.svg")
    files["index.html"] = page.page(found, text(found), pictures)
    for name, content in files.items():
        with open(os.path.join(folder, name), "w") as file:
            file.write(content)
    return [os.path.join(folder, name) for name in (*files, *map(os.path.basename, pictures.values()))]


def heading(found):
    study = found.study
    done = sum(1 for result in found.results.values() if not result["failure"])
    counts = " or ".join(map(str, sorted({ranks(study, case) for case in found.results})))
    lines = [f"# {study.title}", "",
             f"Scene `{os.path.basename(study.scene)}`, study `{os.path.basename(study.file)}`: {done} of "
             f"{len(found.results)} runs have succeeded, on {counts} rank(s) each."]
    settings = [f"`{key} = {value}`" if value else f"no `{key}`" for key, value in study.settings.items()
                if not key.startswith("Probes/")]
    if settings:
        lines += ["", "In all runs: " + ", ".join(settings) + "."]
    return lines + [""]


def text(found, pictures=False):
    """The whole as Markdown."""
    lines = heading(found)
    for k, result in enumerate(found.quantities):
        lines += tables.section(found, result)
        if pictures:
            lines += [f"![error of {result.quantity.name} over {found.study.cost}](work_precision_{k + 1}.png)", ""]
    lines += tables.costs(found) + tables.phases(found)
    for name, reason in found.unevaluated.items():
        lines += [f"**{name}** was not evaluated: {reason}", ""]
    lines += tables.failures(found)
    return "\n".join(lines).rstrip() + "\n"
