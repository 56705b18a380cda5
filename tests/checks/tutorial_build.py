#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""`./undine build` and `./undine test -R unit/MODULE/FILE` for a tutorial that adds sources: these are compiled as their
module was, and linked with the objects of the finished build, which stays as it is.

usage, in a folder that looks like that of the sources: tutorial_build.py BUILD build
                                                        tutorial_build.py BUILD test -R unit/MODULE/FILE
"""
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

FOLDER = pathlib.Path.cwd()


def added_sources():
    return sorted(file for file in (FOLDER / "source").rglob("*.cc") if not file.is_symlink())


def compile_in(module, source, result, build):
    """Compile a source by the command of another one of its module."""
    with open(build / "compile_commands.json") as file:
        known = next(entry for entry in json.load(file)
                     if f"/undine_{module}.dir/" in entry["command"] and entry["file"].endswith((".cc", ".cxx"))
                     and "cmake_pch" not in entry["file"])
    words = shlex.split(known["command"])
    words[words.index("-o") + 1] = str(result)
    words[words.index("-c") + 1] = str(source)
    subprocess.run(words, cwd=known["directory"], check=True)


def objects(build):
    """The sources that have been added, compiled in the folder `build` here."""
    (FOLDER / "build").mkdir(exist_ok=True)
    for source in added_sources():
        result = FOLDER / "build" / f"{source.stem}.o"
        if not result.exists() or result.stat().st_mtime < source.stat().st_mtime:
            module = source.relative_to(FOLDER / "source").parts[0]
            compile_in(module, source, result, build)
        yield result


def link(target, build):
    """Link the target with what was added; returns the program."""
    lines = subprocess.run(["ninja", "-C", build, "-t", "commands", target], capture_output=True, text=True, check=True).stdout
    command = lines.strip().splitlines()[-1]
    program = FOLDER / "build" / os.path.basename(target)
    added = " ".join(shlex.quote(str(each)) for each in objects(build))
    command, count = re.subn(r" -o (\S+)", f" -o {shlex.quote(str(program))} {added}", command, count=1)
    if not count:
        sys.exit(f"the command that links {target} names no output: {command}")
    subprocess.run(command, shell=True, cwd=build, check=True)
    return program


def main():
    build, action, *rest = sys.argv[1:]
    build = pathlib.Path(build).resolve()
    if action == "build":
        print(f"{link('undine', build)} is up to date")
        return
    name = re.fullmatch(r"unit/(\w+)/(\w+)", rest[1]) if rest[:1] == ["-R"] and len(rest) == 2 else None
    if not name:
        sys.exit(f"tutorials can run 'test -R unit/MODULE/FILE' only, not {rest}")
    program = link(f"tests/unit_{name[1]}", build)
    sys.exit(subprocess.run([program, f"[#{name[2]}]", "--filenames-as-tags"]).returncode)


if __name__ == "__main__":
    main()
