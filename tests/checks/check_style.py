#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What CONTRIBUTING.md asks for and a program can see.

usage: check_style.py ROOT      prints FILE:LINE: REASON for every violation

Lengths of files and functions are hints: they are printed, but break no rule.
"""
import ast
import pathlib
import re
import sys

LICENCE = "SPDX-License-Identifier: LGPL-2.1-or-later"
FILE_LINES = 400
FUNCTION_LINES = 60
CPP = {".h", ".cc", ".cu", ".cuh"}

HINTS = {"file", "function"}

# (file, rule): why it may break it
EXCEPTIONS = {
    ("include/undine/base/options/precompiled.h", "guard"): "a list of headers, included by no file",
    ("include/undine/base/options/values.h", "dimension"): "says which variables there are",
}

UNWANTED = {
    "unfinished": (r"\b(TODO|FIXME|XXX)\b", "unfinished work does not go into the repository"),
    "switched off": (r"^\s*#\s*if\s+0\b", "switched-off code does not go into the repository"),
    "dimension": (r"\bdim\s*[=!]=\s*[123]\b", "loop over axis < dim: no case for one dimension"),
    "std": (r"^\s*using\s+namespace\s+std\b", "name what is used of std"),
}


def tracked(root):
    """All files that the rules are about."""
    for tree in ("include", "source", "cuda", "tests", "benchmarks", "contrib", ".ci"):
        for file in sorted((root / tree).rglob("*")):
            if file.is_file() and "__pycache__" not in file.parts:
                yield file
    yield from (file for file in (root / "CMakeLists.txt", root / "undine") if file.exists())


def is_code(file):
    if file.suffix in CPP | {".py", ".sh", ".cmake"} or file.name == "CMakeLists.txt":
        return True
    return file.suffix == "" and file.read_bytes()[:2] == b"#!"


def guard_of(root, file):
    """undine_solid_body_h for include/undine/solid/mesh/body.h; the file's own name elsewhere."""
    include = root / "include"
    if include in file.parents:
        return re.sub(r"[/.]", "_", file.relative_to(include).as_posix())
    return None


def blank_comments_and_strings(text):
    """The same text with the same line breaks, but without comments, strings and directives."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.*?)\)"|"(?:\\.|[^"\\\n])*"'
                         r"|'(?:\\.|[^'\\\n])'|^[ \t]*#(?:\\\n|[^\n])*", re.S | re.M)
    return pattern.sub(lambda match: "\n" * match[0].count("\n"), text)


def cpp_functions(text):
    """(first line, number of lines) of every outermost function body with its signature."""
    text = blank_comments_and_strings(text)
    container = re.compile(r"(?:^|\s)(namespace|class|struct|union|enum|extern)\b[^()]*$")
    label = re.compile(r"^\s*(public|private|protected)\s*:")
    scopes, begin = [], 0  # scopes: True for a function; begin: where the current statement starts
    for match in re.finditer(r"[{};]", text):
        at, sign = match.start(), match[0]
        inside_function = any(scope[0] for scope in scopes)
        if sign == "{":
            head = label.sub("", text[begin:at])
            function = not inside_function and not container.search(head) and "(" in head
            first = text.count("\n", 0, begin + len(text[begin:at]) - len(head.lstrip())) + 1
            scopes.append((function, first))
        elif sign == "}" and scopes:
            function, first = scopes.pop()
            if function:
                yield first, text.count("\n", 0, at) + 1 - first + 1
        if not inside_function or sign == "}":
            begin = at + 1


def python_functions(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            yield node.lineno, node.end_lineno - node.lineno + 1


def check_file(root, file):
    """Triples (line, rule, reason)."""
    text = file.read_text()
    lines = text.splitlines()
    head = lines[1:2] if lines and lines[0].startswith("#!") else lines[:1]
    if not any(LICENCE in line for line in head):
        yield 1, "licence", f"the first line must say '{LICENCE}'"
    if len(lines) > FILE_LINES:
        yield len(lines), "file", f"{len(lines)} lines, more than {FILE_LINES}: is it one concept?"
    for number, line in enumerate(lines, 1):
        for rule, (pattern, why) in UNWANTED.items():
            # Tests may tell dimensions apart, and the checks speak of what they forbid.
            if file.suffix == ".py" or (rule == "dimension" and root / "tests" in file.parents):
                continue
            if re.search(pattern, line):
                yield number, rule, why
    if file.suffix == ".h":
        expected = guard_of(root, file) or r"\w+_h"
        guard = re.search(r"^#ifndef (\w+)\n#define (\w+)$", text, re.M)
        if not guard or guard[1] != guard[2] or not re.fullmatch(expected, guard[1]):
            yield 2, "guard", f"the include guard must be {expected}"
    functions = ()
    if file.suffix in CPP:
        functions = cpp_functions(text)
    elif file.suffix == ".py":
        functions = python_functions(text)
    for number, length in functions:
        if length > FUNCTION_LINES:
            yield number, "function", f"a function of {length} lines, more than {FUNCTION_LINES}"


def local_functions(text):
    """Names of functions in unnamed namespaces, as contrib/indent lays them out."""
    for block in re.finditer(r"^( *)namespace\n\1\{\n(.*?)^\1\} // namespace$", text, re.S | re.M):
        margin = " " * (len(block[1]) + 2)
        for function in re.finditer(rf"^{margin}(\w+)\([^;{{}}]*?\)[^;{{}}]*?\n{margin}\{{", block[2], re.M | re.S):
            yield function[1]


def shared_names(root):
    """Pairs (file, reason): `./undine` compiles several sources of a module as one, in which another function of the same name
    would be an overload, and could be taken for the one that is meant."""
    known = {}
    for file in sorted((root / "source").rglob("*.cc")):
        module = file.relative_to(root / "source").parts[0]
        for name in sorted(set(local_functions(file.read_text()))):
            other = known.setdefault((module, name), file)
            if other != file:
                yield file, f"function '{name}' in an unnamed namespace has the name of one in {other.relative_to(root).as_posix()}"


def remarks(root):
    """Pairs (rule, FILE:LINE: REASON)."""
    for file, why in shared_names(root):
        yield "shared name", f"{file.relative_to(root).as_posix()}: {why}"
    for file in tracked(root):
        if is_code(file):
            name = file.relative_to(root).as_posix()
            for number, rule, why in check_file(root, file):
                if (name, rule) not in EXCEPTIONS:
                    yield rule, f"{name}:{number}: {why}"


def problems(root):
    return [text for rule, text in remarks(root) if rule not in HINTS]


def hints(root):
    return [text for rule, text in remarks(root) if rule in HINTS]


def main():
    root = pathlib.Path(sys.argv[1])
    found = []
    for rule, text in remarks(root):
        if rule in HINTS:
            print(f"hint: {text}")
        else:
            found.append(text)
    count = sum(1 for file in tracked(root) if is_code(file))
    if count == 0:
        found.append(f"{root}: no files found")
    if found:
        sys.exit("\n".join(found))
    print(f"{count} files follow the rules")


if __name__ == "__main__":
    main()
