#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Includes follow the order of the modules and their folders (doc/architecture.md); neither folders nor headers
have cycles, and no folder is crowded.

usage: check_include_direction.py ROOT      prints FILE:LINE: REASON for every violation
"""
import pathlib
import re
import sys

BASE = {"base/core", "base/options", "base/parallel", "base/multigrid"}
GEOMETRY = {"surface", "cutting", "operators", "contact"}
PHYSICS = BASE | GEOMETRY | {"solid", "fluid", "particles"}

# Folder: what it may include besides itself. A folder is a module or, as "module/folder", a folder of one; the
# name of a module stands for all of its folders. Files directly in a module that has folders are a folder, too.
SEES = {
    "base/core": set(),
    "base/options": {"base/core"},
    "base/parallel": {"base/core"},
    "base/multigrid": {"base/core", "base/parallel"},

    "solid/material": BASE,
    "solid/time": BASE,
    "solid/mesh": BASE | {"solid/material", "solid/time"},
    "solid/assembly": BASE | {"solid/material", "solid/mesh"},
    "solid/solvers": BASE | {"solid/mesh", "solid/assembly"},
    "solid/step": BASE | {"solid/time", "solid/mesh", "solid/assembly", "solid/solvers"},

    "fluid/grid": BASE,
    "fluid/boundary": BASE | {"fluid/grid"},
    "fluid/model": BASE | {"fluid/grid", "fluid/boundary"},
    "fluid/visibility": BASE | {"fluid/grid"},
    "fluid/advection": BASE | {"fluid/grid", "fluid/boundary", "fluid/model", "fluid/visibility"},
    "fluid/convection": BASE | {"fluid/grid", "fluid/boundary", "fluid/model", "fluid/visibility"},
    "fluid/viscosity": BASE | {"fluid/grid", "fluid/boundary", "fluid/model", "fluid/convection"},
    "fluid/pressure": BASE | {"fluid/grid", "fluid/boundary", "fluid/model"},
    "fluid/scalars": BASE | {"fluid/grid", "fluid/boundary", "fluid/model", "fluid/visibility", "fluid/advection",
                             "fluid/viscosity", "fluid/pressure"},
    "fluid": BASE | {"fluid/grid", "fluid/boundary", "fluid/model", "fluid/advection", "fluid/convection",
                     "fluid/viscosity", "fluid/pressure"},

    "particles/math": set(),
    "particles/execution": {"particles/math"},
    "particles/model": {"base/core", "particles/math", "particles/execution"},
    "particles/boundaries": {"particles/math", "particles/execution", "particles/model"},
    "particles/setup": {"base/core", "particles/model", "particles/boundaries"},
    "particles/neighbours": {"particles/math", "particles/execution", "particles/model"},
    "particles/fluid": {"particles/math", "particles/execution", "particles/model",
                        "particles/neighbours"},
    "particles/elasticity": {"particles/math", "particles/execution", "particles/model",
                             "particles/setup", "particles/neighbours"},
    "particles/pressure": {"particles/math", "particles/execution", "particles/model",
                           "particles/neighbours", "particles/fluid", "particles/elasticity"},
    "particles/multigrid": {"particles/math", "particles/execution", "particles/model",
                            "particles/neighbours", "particles/pressure"},
    "particles/engine": {"base/core", "particles"},
    "cuda": {"base/core", "particles"},

    "surface": BASE | {"solid/mesh", "fluid/grid", "fluid/visibility"},
    "cutting": BASE | {"surface", "fluid/grid", "fluid/boundary"},
    "operators": BASE | {"surface", "cutting", "fluid/grid", "fluid/boundary", "fluid/visibility",
                         "fluid/viscosity", "fluid/pressure"},
    "contact": BASE | {"surface", "solid/mesh", "solid/assembly", "fluid/grid", "fluid/model"},
    "effects": BASE | {"solid/mesh", "solid/assembly", "fluid", "particles/setup"},
    "particle_model": BASE | {"solid/material", "solid/mesh", "fluid/boundary", "surface", "particles",
                              "effects"},

    "coupled/model": PHYSICS | {"effects", "particle_model"},
    "coupled/state": BASE | {"solid/mesh", "solid/assembly", "fluid/grid", "particles/model"},
    "coupled/linear": BASE | {"solid/solvers"},
    "coupled/immersed": PHYSICS | {"coupled/model", "coupled/state", "coupled/linear"},
    "coupled/budget": PHYSICS | {"coupled/model", "coupled/state"},
    "coupled/step": PHYSICS | {"coupled/model", "coupled/state", "coupled/linear", "coupled/immersed",
                               "coupled/budget"},
    "coupled/adaptivity": PHYSICS | {"coupled/model", "coupled/state", "coupled/budget", "coupled/step"},
    "coupled/stability": PHYSICS | {"coupled/model", "coupled/state", "coupled/immersed"},
    "coupled/scheme": PHYSICS | {"particle_model", "coupled"},

    "output/files": BASE,
    "output/checkpoint": PHYSICS | {"coupled", "output/files"},
    "output/fields": PHYSICS | {"particle_model", "coupled", "output/files"},
    "output/probes": PHYSICS | {"particle_model", "coupled", "output/files", "output/fields"},
    "output": PHYSICS | {"coupled", "output"},
    "scene": PHYSICS | {"effects", "particle_model", "coupled", "output"},
    "driver": PHYSICS | {"effects", "particle_model", "coupled", "output", "scene"},
}
WITHOUT_DEAL_II = ("base/core", "particles", "cuda")

INCLUDE = re.compile(r"\s*#\s*include\s*[<\"]([^>\"]+)[>\"]")
SUFFIXES = {".h", ".cc", ".cu", ".cuh"}
MOST_FILES = 25


def folder_of(path):
    """The folder that owns a path like base/core/clock.h or solid/material/materials/neo_hookean.cc, as it is
    called in SEES; None if it is in no folder."""
    parts = pathlib.PurePosixPath(path).parts
    if len(parts) > 2 and "/".join(parts[:2]) in SEES:
        return "/".join(parts[:2])
    has_folders = any(folder.startswith(parts[0] + "/") for folder in SEES)
    if len(parts) == 1 or parts[0] not in SEES or (has_folders and len(parts) > 2):
        return None
    return parts[0]


def may_see(folder, other):
    """Whether what is in `folder` may include what is in the folder `other`."""
    return other == folder or other in SEES[folder] or other.split("/")[0] in SEES[folder]


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


def reason(folder, included):
    """Why `folder` may not include `included`; empty if it may."""
    if included.startswith("undine/"):
        other = folder_of(included[len("undine/"):])
        if other is None:
            return f"<{included}> belongs to no folder"
        return "" if may_see(folder, other) else f"'{folder}' must not see '{other}': <{included}>"
    if included.startswith("deal.II/") and folder.startswith(WITHOUT_DEAL_II):
        return f"'{folder}' must not see deal.II: <{included}>"
    if folder == "base/core" and not re.fullmatch(r"[a-z_]+", included):
        return f"'{folder}' uses the standard library only: <{included}>"
    return ""


def wrong_directions(root):
    for file, inside in sources(root):
        folder = folder_of(inside)
        if folder is None:
            yield f"{file.relative_to(root)}:1: belongs to no folder of doc/architecture.md"
            continue
        for number, included in includes(file):
            why = reason(folder, included)
            if why:
                yield f"{file.relative_to(root)}:{number}: {why}"


def cycles_of_folders(root):
    """Folders that see each other, directly or through others: by what they include."""
    graph = {}
    for file, inside in sources(root):
        folder = folder_of(inside)
        graph.setdefault(folder, set())
        for _, included in includes(file):
            if included.startswith("undine/"):
                graph[folder].add(folder_of(included[len("undine/"):]))
    yield from cycles_in({folder: sorted(other for other in others if other and other != folder)
                          for folder, others in graph.items() if folder})


def cycles_of_headers(root):
    """Headers that include themselves through others."""
    yield from cycles_in(
        {"undine/" + inside: [name for _, name in includes(file) if name.startswith("undine/")]
         for file, inside in sources(root) if file.suffix == ".h"})


def cycles_in(graph):
    done = set()

    def visit(node, trail):
        if node in trail:
            yield "cycle: " + " -> ".join(trail[trail.index(node):] + [node])
        elif node not in done:
            for other in graph.get(node, []):
                yield from visit(other, trail + [node])
            done.add(node)

    for node in graph:
        yield from visit(node, [])


def crowded_folders(root):
    """Folders with more files than one can take in."""
    for tree in ("include/undine", "source", "cuda", "tests/unit"):
        for folder in [root / tree, *sorted((root / tree).rglob("*"))]:
            count = sum(file.suffix in SUFFIXES for file in folder.iterdir()) if folder.is_dir() else 0
            if count > MOST_FILES:
                yield f"{folder.relative_to(root)}:1: {count} files; more than {MOST_FILES}: which folders are in it?"


def problems(root):
    yield from wrong_directions(root)
    yield from cycles_of_folders(root)
    yield from cycles_of_headers(root)
    yield from crowded_folders(root)


def main():
    root = pathlib.Path(sys.argv[1])
    count = len(list(sources(root)))
    found = list(problems(root))
    if count == 0:
        found.append(f"{root}: no sources found")
    if found:
        sys.exit("\n".join(found))
    print(f"{count} files: all includes point downwards")


if __name__ == "__main__":
    main()
