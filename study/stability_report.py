# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes maps of stability: a picture, tables, and a page that holds them."""
import csv
import io
import os

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # noqa: E402

from study import page, tables  # noqa: E402
from study.page import plain  # noqa: E402
from study.stability import VERDICTS, verdict  # noqa: E402

LOOKS = {"stable": ("o", "C2"), "undecided": ("s", "C7"), "growing": ("^", "C1"), "failed": ("x", "C3")}


def panels(found):
    """{positions in what is no range: [(horizontal number, line)]}: a picture for each variant and each value of a third
    range; the horizontal axis is that of the last range but one."""
    study, axis = found.study, found.axis
    others = [k for k in range(len(study.variations)) if k != axis]
    ranges = [k for k in study.ranges() if k != axis]
    result = {}
    for line in found.lines():
        positions = dict(zip(others, line))
        across = positions.pop(ranges[-1]) if ranges else 0
        number = study.variations[ranges[-1]].lengths[across] if ranges else 1.0
        result.setdefault(tuple(positions.items()), []).append((number, line))
    return result


def label(variation):
    return f"{variation.name} ({', '.join(variation.settings[0])})"


def draw(found, path):
    study, found_panels = found.study, panels(found)
    lines, boundaries = found.lines(), found.boundaries()
    figure, axes = pyplot.subplots(1, len(found_panels), figsize=(4.2 * len(found_panels) + 0.4, 4.8), squeeze=False,
                                   sharey=True)
    for place, (fixed, columns) in zip(axes[0], found_panels.items()):
        for word in VERDICTS:
            points = [(number, found.number(case)) for number, line in columns for case in lines[line]
                      if verdict(found.results[case]) == word]
            marker, colour = LOOKS[word]
            place.plot(*zip(*points) if points else ([], []), marker, color=colour, label=word, markersize=6,
                       linestyle="none")
        edges = [(number, each.value()) for number, line in columns for each in boundaries if each.line == line]
        place.plot(*zip(*edges) if edges else ([], []), "_", color="black", markersize=18, label="boundary", linestyle="none")
        if found.study.linear_theory:
            foretold = sorted((number, value) for number, line in columns for other, value in found.foretold if other == line)
            place.plot(*zip(*foretold) if foretold else ([], []), "--", color="C0", linewidth=1, marker=".", markersize=3,
                       label="boundary by linear theory")
        title = ", ".join(study.variations[k].names[position] for k, position in fixed) or study.title
        place.set_title(plain(title), fontsize=10)
        place.set_xscale("log")
        place.set_yscale("log")
        place.grid(alpha=0.3, which="both", linewidth=0.4)
        ranges = [k for k in study.ranges() if k != found.axis]
        if ranges:
            across = study.variations[ranges[-1]]
            place.set_xticks(across.lengths, list(map(plain, across.names)), fontsize=8)
            place.xaxis.set_minor_locator(ticker.NullLocator())
            place.set_xlabel(plain(label(across)), fontsize=8)
        else:
            place.set_xticks([])
    axes[0][0].set_ylabel(plain(label(study.variations[found.axis])), fontsize=8)
    handles = axes[0][0].get_legend_handles_labels()
    figure.suptitle(plain(study.title), fontsize=11)
    figure.tight_layout(rect=(0, 0.07, 1, 1))
    figure.legend(*handles, loc="lower center", ncol=6, fontsize=9)
    figure.savefig(path, dpi=100)
    pyplot.close(figure)


def rows_of_boundaries(found):
    """A row for each line: where it is stable."""
    boundaries = found.boundaries()
    for line, cases in found.lines().items():
        words = [verdict(found.results[case]) for case in cases]
        counts = ", ".join(f"{words.count(word)} {word}" for word in VERDICTS if word in words)
        edges = "; ".join(f"stable at {each.stable:.4g}, {each.verdict} at {each.unstable:.4g}" for each in boundaries
                          if each.line == line)
        row = [*found.names_of(line), counts, edges or ("everywhere" if words[0] == "stable" else "nowhere")]
        if found.study.linear_theory:
            row.append("; ".join(f"{value:.4g}" for other, value in found.foretold if other == line) or "none")
        yield row


def text(found, pictures=False):
    """The whole as Markdown."""
    study = found.study
    others = [variation.name for k, variation in enumerate(study.variations) if k != found.axis]
    last = study.variations[found.axis].name
    said = sum(1 for result in found.results.values() if verdict(result))
    lines = [f"# {study.title}", "",
             f"Scene `{os.path.basename(study.scene)}`, study `{os.path.basename(study.file)}`: {said} of {len(found.results)} runs "
             f"have a verdict, {found.n_first} of them on the grid of values, the others to find where {last} begins to be "
             f"stable, to a factor of {study.boundary:g}."]
    if study.settings:
        lines += ["", "In all runs: " + ", ".join(f"`{key} = {value}`" for key, value in study.settings.items()) + "."]
    if pictures:
        lines += ["", "![verdicts of all runs](stability.png)"]
    theory = ["boundary by linear theory"] if study.linear_theory else []
    lines += ["", "## Boundaries", "",
              *tables.table([*others, "runs", f"where {last} is stable", *theory], rows_of_boundaries(found))]
    lines += ["## Runs that are not stable", ""]
    rows = [[*[variation.names[position] for variation, position in zip(study.variations, case.index)],
             verdict(result), reason(result)]
            for case, result in sorted(found.results.items(), key=lambda item: (item[0].index, found.number(item[0])))
            if verdict(result) in VERDICTS[1:]]
    lines += tables.table([variation.name for variation in study.variations] + ["verdict", "why"], rows) if rows else ["None.", ""]
    return "\n".join(lines).rstrip() + "\n"


def reason(result):
    said = result.get("verdict in words") or result["failure"]
    return " ".join((tables.reason(result) if result["failure"] else said).replace("|", "/").split())


def csv_of(found):
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow([variation.name for variation in found.study.variations] + ["verdict", "why", "core seconds"])
    for case, result in sorted(found.results.items(), key=lambda item: item[0].index):
        writer.writerow([variation.names[position] for variation, position in zip(found.study.variations, case.index)] +
                        [verdict(result) or result["failure"], reason(result) if verdict(result) else "",
                         f"{result['core seconds']:.4g}" if "core seconds" in result else ""])
    return stream.getvalue()


def page_of(found, path):
    with open(path) as file:
        svg = file.read()
    figure = f"<figure>{svg[svg.index('<svg'):]}<figcaption>Verdicts of all runs.</figcaption></figure>"
    return page.document(found.study.title, page.body(text(found), {found.study.title: figure}))


def write(found, folder):
    """All files; returns their paths."""
    for kind in ("svg", "png"):
        draw(found, os.path.join(folder, f"stability.{kind}"))
    files = {"stability.md": text(found, pictures=True), "stability.csv": csv_of(found),
             "index.html": page_of(found, os.path.join(folder, "stability.svg"))}
    for name, content in files.items():
        with open(os.path.join(folder, name), "w") as file:
            file.write(content)
    return [os.path.join(folder, name) for name in (*files, "stability.svg", "stability.png")]
