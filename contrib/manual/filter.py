#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
r"""Print a document as Doxygen wants it: $...$ as \f$...\f$, $$ as \f[ and \f], headings with names, and links to
documents and headings by these names.

usage: filter.py FILE.md      in the root of the sources
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "checks"))
from check_documents import LINK, anchors, documents, without_code  # noqa: E402

WHOLE_LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")



def label(file, anchor=""):
    """The name of a document or of one of its headings."""
    name = re.sub(r"\W", "_", str(file.resolve().relative_to(ROOT).with_suffix("")))
    return "index" if name == "README" and not anchor else f"{name}_{re.sub(r'[^A-Za-z0-9]', '_', anchor)}".rstrip("_")


def names_of_headings(file):
    """Labels in the order of the headings, the first of which is the document's own."""
    names = [label(file)]
    for anchor in list(anchors(file))[1:]:
        name = label(file, anchor)
        names.append(name if name not in names else f"{name}_{len(names)}")
    return names


def target(file, path, pages):
    """The label that a link leads to, or None if no page of the manual has it."""
    path, _, anchor = path.partition("#")
    page = (file.parent / path).resolve() if path else file.resolve()
    return label(page, anchor) if page in pages else None


def converted(file, line, masked, pages):
    """A line outside of displayed formulas. The words of a link may begin on the line before."""
    changes = [(match.start(), match.end(), r"\f$") for match in re.finditer(r"(?<!\\)\$", masked)]
    for match in LINK.finditer(masked):
        found = target(file, match[1], pages)
        if found:
            changes.append((*match.span(), f"](@ref {found})"))
    for match in WHOLE_LINK.finditer(masked):
        image = masked[:match.start()].endswith("!")
        if not image and not re.match("[a-z]+:", match[1]) and not target(file, match[1], pages):
            # Beyond the manual: the words alone.
            changes += [(match.start(), match.start() + 1, ""), (match.start(1) - 2, match.end(), "")]
    for at, end, text in sorted(changes, reverse=True):
        line = line[:at] + text + line[end:]
    return line


def main():
    file = pathlib.Path(sys.argv[1])
    text = file.read_text()
    pages = {page.resolve() for page in documents(ROOT)}
    names = iter(names_of_headings(file))
    display = False
    for line, masked in zip(text.splitlines(), without_code(text).splitlines()):
        if masked.strip() == "$$":
            display = not display
            print(r"\f[" if display else r"\f]")
        elif display:
            print(line)
        elif re.match("#+ ", masked):
            name = next(names)
            print(converted(file, line, masked, pages), "" if name == "index" else f"{{#{name}}}")
        else:
            print(converted(file, line, masked, pages))


if __name__ == "__main__":
    main()
