# SPDX-License-Identifier: LGPL-2.1-or-later
"""One HTML page without anything from outside: the text of a study, with its tables and pictures."""
import html
import re

STYLE = """
body { font: 15px/1.5 sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; color: #222; }
table { border-collapse: collapse; margin: 1em 0; font-size: 13px; }
td, th { border: 1px solid #ccc; padding: 2px 8px; text-align: left; font-variant-numeric: tabular-nums; }
th { background: #f2f2f2; }
code { background: #f2f2f2; padding: 0 3px; }
figure { margin: 1em 0; } figure svg { max-width: 100%; height: auto; }
figcaption { font-size: 13px; color: #555; }
"""


def plain(text):
    """For Matplotlib, which takes what stands between two $ for a formula."""
    return text.replace("$", r"\$")


def inline(text):
    """Bold and code of Markdown."""
    text = html.escape(text, quote=False)
    text = re.sub(r"\*\*(.+?)\*\*", r"<b>\1</b>", text)
    return re.sub(r"`(.+?)`", r"<code>\1</code>", text)


def cells(line, tag):
    parts = (part.replace(r"\|", "|") for part in line.strip().strip("|").split(" | "))
    return "<tr>" + "".join(f"<{tag}>{inline(part.strip())}</{tag}>" for part in parts) + "</tr>"


def body(text, figures):
    """HTML of the few forms of Markdown that studies use; figures by heading, behind the first paragraph."""
    result, table, items, heading = [], [], [], ""
    for line in [*text.splitlines(), ""]:
        if line.startswith("|"):
            table.append(line)
            continue
        if line.startswith("- "):
            items.append(f"<li>{inline(line[2:])}</li>")
            continue
        if table:
            result.append("<table>" + cells(table[0], "th") + "".join(cells(each, "td") for each in table[2:]) + "</table>")
            table = []
        if items:
            result.append("<ul>" + "".join(items) + "</ul>")
            items = []
        level = len(line) - len(line.lstrip("#"))
        if level:
            heading = line[level:].strip()
            result.append(f"<h{level}>{inline(heading)}</h{level}>")
        elif line:
            result.append(f"<p>{inline(line)}</p>")
            if heading in figures:
                result.append(figures.pop(heading))
    return "\n".join(result)


def inline_svg(text, name):
    """The text of a file, to stand in a page; `name`: of this picture among those of the page."""
    svg = text[text.index("<svg"):]
    prefix = re.sub(r"\W", "_", name)  # identifiers of several pictures must not meet
    svg = re.sub(r'id="', f'id="{prefix}_', svg)
    return re.sub(r'(href="#|url\(#)', rf"\g<1>{prefix}_", svg)


def figure(found, name, path):
    with open(path) as file:
        svg = inline_svg(file.read(), name)
    return (f"<figure>{svg}<figcaption>Relative error of {html.escape(name)} over {found.study.cost}. Circles: no other "
            "run is both cheaper and more accurate.</figcaption></figure>")


def document(title, content):
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}</title>'
            f"<style>{STYLE}</style></head><body>\n{content}\n</body></html>\n")


def page(found, text, pictures):
    """`pictures`: {name of the quantity: path of its SVG}."""
    figures = {name: figure(found, name, path) for name, path in pictures.items()}
    return document(found.study.title, body(text, figures))
