#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Includes follow the order of the modules (doc/architecture.md), and headers have no cycles.

usage: check_include_direction.py ROOT      prints FILE:LINE: REASON for every violation
"""
import pathlib
import re
import sys

BASE = {"base/core", "base/options", "base/parallel"}
PHYSICS = BASE | {"solid", "fluid", "interface", "particles"}

# module: what it may include besides itself
SEES = {
    "base/core": set(),
    "base/options": {"base/core"},
    "base/parallel": {"base/core"},
    "solid": BASE,
    "fluid": BASE,
    "particles": {"base/core"},
    "cuda": {"base/core", "particles"},
    "interface": BASE | {"solid", "fluid"},
    "effects": PHYSICS,
    "coupled": PHYSICS | {"effects"},
    "output": PHYSICS | {"effects", "coupled"},
    "scene": PHYSICS | {"effects", "coupled", "output"},
    "driver": PHYSICS | {"effects", "coupled", "output", "scene"},
    "study": PHYSICS | {"effects", "coupled", "output", "scene", "driver"},
}
STANDARD_LIBRARY_ONLY = {"base/core", "particles", "cuda"}
WITHOUT_DEAL_II = {"particles", "cuda"}

INCLUDE = re.compile(r"\s*#\s*include\s*[<\"]([^>\"]+)[>\"]")
SUFFIXES = {".h", ".cc", ".cu", ".cuh"}


def module_of(path):
    """The module that owns a path like base/core/clock.h; None if it is in no module."""
    parts = pathlib.PurePosixPath(path).parts
    if len(parts) > 2 and parts[0] == "base":
        return "/".join(parts[:2])
    return parts[0] if len(parts) > 1 else None


def sources(root):
    """Pairs (file, path below its module tree)."""
    for tree in ("include/undine", "source", "cuda"):
        base = root / tree
        for file in sorted(base.rglob("*")):
            if file.suffix in SUFFIXES:
                inside = file.relative_to(base).as_posix()
                yield file, ("cuda/" + inside if tree == "cuda" else inside)


def includes(file):
    """Pairs (line number, included name)."""
    for number, line in enumerate(file.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match[1]


def reason(module, included):
    """Why `module` may not include `included`; empty if it may."""
    if included.startswith("undine/"):
        other = module_of(included[len("undine/"):])
        if other == module or other in SEES[module]:
            return ""
        if other not in SEES:
            return f"<{included}> belongs to no module"
        return f"module '{module}' must not see module '{other}': <{included}>"
    if included.startswith("deal.II/") and module in WITHOUT_DEAL_II | STANDARD_LIBRARY_ONLY:
        return f"module '{module}' must not see deal.II: <{included}>"
    if module == "base/core" and not re.fullmatch(r"[a-z_]+", included):
        return f"module '{module}' uses the standard library only: <{included}>"
    return ""


def wrong_directions(root):
    for file, inside in sources(root):
        module = module_of(inside)
        if module not in SEES:
            yield f"{file.relative_to(root)}:1: belongs to no module of doc/architecture.md"
            continue
        for number, included in includes(file):
            why = reason(module, included)
            if why:
                yield f"{file.relative_to(root)}:{number}: {why}"


def cycles(root):
    """Headers that include themselves through others."""
    graph = {"undine/" + inside: [name for _, name in includes(file) if name.startswith("undine/")]
             for file, inside in sources(root) if file.suffix == ".h"}
    done = set()

    def visit(header, trail):
        if header in trail:
            yield "cycle: " + " -> ".join(trail[trail.index(header):] + [header])
        elif header not in done:
            for other in graph.get(header, []):
                yield from visit(other, trail + [header])
            done.add(header)

    for header in graph:
        yield from visit(header, [])


def main():
    root = pathlib.Path(sys.argv[1])
    count = len(list(sources(root)))
    problems = list(wrong_directions(root)) + list(cycles(root))
    if count == 0:
        problems.append(f"{root}: no sources found")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{count} files: all includes point downwards")


if __name__ == "__main__":
    main()
