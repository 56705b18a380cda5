#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The documents' links lead somewhere, their formulas can be rendered, and every equation number that the
sources or the documents cite is defined exactly once.

usage: check_documents.py ROOT      prints FILE:LINE: REASON for every violation
"""
import pathlib
import re
import sys

SUFFIXES = {".h", ".cc", ".cu", ".cuh"}
NUMBER = r"[A-Z]\d+[a-z]?"
CITED = re.compile(rf"\(({NUMBER})\)")
TAG = re.compile(r"\\tag\{([^}]*)\}")
LINK = re.compile(r"\]\(([^)\s]+)\)")  # its words may begin on the line before
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)
# An escape that Markdown takes for its own, as \, and \{ are; \\ at the end of a row is none.
ESCAPE = re.compile(r"(?<!\\)\\[!-/:-@\[\]^-`{-~]")
MARKER = re.compile(r"\s*([-+*>#|]|=+$|\d+[.)])(\s|$)")


def documents(root):
    """All files whose links and formulas are looked at."""
    for file in (root / "README.md", root / "CONTRIBUTING.md", root / "CHANGELOG.md"):
        if file.exists():
            yield file
    for folder in (root / "doc", root / "doc" / "tutorials"):
        yield from sorted(folder.glob("*.md"))


def without_code(text):
    """The same lines with blanks for code: fenced, indented and in spans."""
    lines, fence, indented = [], None, False
    for line in text.splitlines():
        mark = re.match(r"\s*(```+|~~~+)", line)
        above = lines[-1].strip() if lines else ""
        indented = line.startswith("    ") and (indented or not above)
        if mark and fence is None:
            fence, line = mark[1], ""
        elif fence is not None:
            fence, line = (None if mark and mark[1].startswith(fence) else fence), ""
        elif indented:
            line = ""
        lines.append(line)
    blank = lambda match: re.sub(r"[^\n]", " ", match[0])
    return re.sub(r"(`+)(?!`)(?:(?!\n[ \t]*\n).)*?(?<!`)\1(?!`)", blank, "\n".join(lines), flags=re.S)


def anchors(file):
    """What links to the headings of a document are called."""
    for heading in re.findall(r"^#+ (.*)$", file.read_text(), re.M):
        yield re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")


def broken_links(file, text):
    """Pairs (line, reason)."""
    for match in LINK.finditer(text):
        path, _, anchor = match[1].partition("#")
        if re.match(r"[a-z]+:", path):
            continue
        target = file.parent / path if path else file
        line = text.count("\n", 0, match.start()) + 1
        if not target.exists():
            yield line, f"the link '{match[1]}' leads to nothing"
        elif anchor and target.suffix == ".md" and anchor not in anchors(target):
            yield line, f"'{target.name}' has no heading '#{anchor}'"


def blocks_of(lines):
    """Triples (first line, formula, reason or empty) of all that stands between lines '$$'."""
    begin = None
    for number, line in enumerate(lines, 1):
        if line.strip() == "$$":
            if begin is None:
                begin = number
                good = number == 1 or not lines[number - 2].strip()
            else:
                good = number == len(lines) or not lines[number].strip()
                yield begin + 1, "\n".join(lines[begin:number - 1]), ""
                begin = None
            if not good:
                yield number, "", "a displayed formula needs blank lines around it"
        elif "$$" in line:
            yield number, "", "'$$' stands on a line of its own"
        elif begin is not None and not line.strip():
            yield number, "", f"a blank line in a formula, or no end of that of line {begin}"
            begin = None
        elif begin is not None and MARKER.match(line):
            yield number, "", "Markdown takes the begin of this line for a list, heading or quotation"
    if begin is not None:
        yield begin, "", "the formula that begins here has no end"


def inline_of(lines):
    """Triples (line, formula, reason or empty) of all that stands between '$' within a line."""
    inside = False
    for number, line in enumerate(lines, 1):
        if line.strip() == "$$":
            inside = not inside
        elif not inside and "$$" not in line:
            places = [match.start() for match in re.finditer(r"(?<!\\)\$", line)]
            if len(places) % 2:
                yield number, "", "an inline formula must begin and end with '$' on this line"
                continue
            for begin, end in zip(places[::2], places[1::2]):
                formula, before, after = line[begin + 1:end], line[:begin][-1:], line[end + 1:][:1]
                good = (formula.strip() == formula != "" and (not before or before in " (|\"*")
                        and (not after or after in " ).,;:!?|\"*"))
                yield number, formula, "" if good else f"'${formula}$': no blanks within, one or a bracket outside"


def unbalanced(formula):
    """Why the formula cannot be typeset; empty if it can."""
    depth = 0
    for brace in re.findall(r"(?<!\\)[{}]", formula):
        depth += 1 if brace == "{" else -1
        if depth < 0:
            break
    if depth:
        return "braces {} do not match"
    if len(re.findall(r"\\left(?![a-z])", formula)) != len(re.findall(r"\\right(?![a-z])", formula)):
        return "\\left and \\right do not match"
    stack = []
    for kind, name in re.findall(r"\\(begin|end)\{(\w+\*?)\}", formula):
        if kind == "begin":
            stack.append(name)
        elif not stack or stack.pop() != name:
            return f"\\end{{{name}}} without its \\begin"
    return f"\\begin{{{stack[-1]}}} without its \\end" if stack else ""


def eaten_by_markdown(formula):
    """What a renderer of Markdown would change in the formula before it is typeset; empty if nothing."""
    if "*" in formula:
        return "'*' may become emphasis: \\ast"
    if "](" in formula:
        return "'](' may become a link: a blank between them"
    escape = ESCAPE.search(re.sub(r"\\\\$", "", formula, flags=re.M))
    if escape:
        return f"Markdown takes the backslash of '{escape[0]}' for its own"
    opened = False
    for match in re.finditer(r"(?<=(.))_(?=(.))", " " + formula.replace("\n", " ") + " "):
        before, after = match[1].isalnum(), match[2].isalnum()
        if opened and not match[1].isspace() and not after:
            return "two '_' may become emphasis: no bracket before the first or none after the last"
        opened = opened or (not before and not match[2].isspace())
    return ""


def wrong_formulas(text):
    """Pairs (line, reason)."""
    lines = text.splitlines()
    for find in (blocks_of, inline_of):
        for line, formula, reason in find(lines):
            reason = reason or unbalanced(formula) or eaten_by_markdown(formula)
            if not reason and find is inline_of and "\\tag" in formula:
                reason = "\\tag belongs to displayed formulas"
            if reason:
                yield line, reason


def wrong_numbers(root, texts):
    """Strings FILE:LINE: REASON about numbers that are defined twice, or cited and not defined."""
    defined, cited = {}, []
    for file, text in texts.items():
        for match in TAG.finditer(text):
            place = f"{file.relative_to(root)}:{text.count(chr(10), 0, match.start()) + 1}"
            if match[1] in defined:
                yield f"{place}: the number ({match[1]}) is that of {defined[match[1]]}, too"
            defined.setdefault(match[1], place)
        cited += [(file, text, match.start(), match[1]) for match in CITED.finditer(text)]
    for tree in ("include", "source", "cuda"):
        for file in sorted((root / tree).rglob("*")):
            if file.suffix in SUFFIXES:
                text = file.read_text()
                cited += [(file, text, part.start() + match.start(), match[1])
                          for part in COMMENT_OR_STRING.finditer(text) for match in CITED.finditer(part[0])]
    for file, text, at, number in cited:
        if number not in defined:
            line = text.count("\n", 0, at) + 1
            yield f"{file.relative_to(root)}:{line}: no document defines the equation ({number})"


def pictures_of_one_name(root):
    """The manual keeps all pictures in one folder."""
    seen = {}
    for file in sorted((root / "doc").rglob("*.png")):
        if file.relative_to(root / "doc").parts[0] != "studies" and (other := seen.setdefault(file.name, file)) != file:
            yield f"{file.relative_to(root)}: has the name of {other.relative_to(root)}"


def problems(root):
    yield from pictures_of_one_name(root)
    texts = {file: without_code(file.read_text()) for file in documents(root)}
    for file, text in texts.items():
        for line, reason in [*broken_links(file, text), *wrong_formulas(text)]:
            yield f"{file.relative_to(root)}:{line}: {reason}"
    yield from wrong_numbers(root, texts)


def main():
    root = pathlib.Path(sys.argv[1])
    count = len(list(documents(root)))
    found = list(problems(root))
    if count == 0:
        found.append(f"{root}: no documents found")
    if found:
        sys.exit("\n".join(found))
    print(f"{count} documents: links, formulas and numbers are in order")


if __name__ == "__main__":
    main()
