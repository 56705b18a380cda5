#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Do what a tutorial says, command by command, in a folder that looks like that of the sources.

usage: check_tutorials.py BUILD PAGE.md [--full] [--in EMPTY_FOLDER]

A comment before a block of the page says what the block is:
    <!-- run -->                     commands
    <!-- run: Time/End=0.1 | A/B=c -->  commands; in the short form every scene gets these settings
    <!-- on a device: Time/End=0.1 -->  the same, left out where there is no CUDA device
    <!-- fails 2 -->                 a command that must end with this exit code
    <!-- prints -->                  lines that the commands before have printed, in this order; ... are left out
    <!-- file: NAME -->, <!-- more of: NAME -->   what to write to a file, or at its end
    <!-- not run: WHY -->
The short form also makes one small picture in the place of all. With --full all is done as it is written, and what the page
says of time, memory and disk must be true within a factor of 3. In a folder that is named all results stay, to look at.
"""
import os
import pathlib
import re
import resource
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

import scene_tools

ROOT = pathlib.Path(scene_tools.ROOT)
BLOCK = re.compile(r"(?:^<!-- (.*?) -->\n)?^```(\w*)\n(.*?)^```$", re.M | re.S)
TAKES = re.compile(r"It takes about (\d+) (s|min) on one core, (\d+) MB of memory and (\d+) MB of disk")
# What a page may say: seconds and megabytes below these count as these.
LEAST = {"core seconds": 5.0, "memory": 200.0, "disk": 2.0}
FACTOR = 3

LAUNCHER = """#!/bin/sh
set -eu
program={program} python_parts={root}
fail() {{ echo "undine: $*" >&2; exit 1; }}
prepare() {{ :; }}
case $1 in
  build | test) exec {python} -B {root}/tests/checks/tutorial_build.py {build} "$@" ;;
esac
[ ! -x build/undine ] || program=$PWD/build/undine
. {root}/contrib/launch.sh
hand_over "$@"
"""


class Fault(Exception):
    pass


def blocks(text):
    """Triples (marker, its settings or name, the block). Blocks of commands must have a marker."""
    for marker, language, body in BLOCK.findall(text):
        if language == "sh" and not marker:
            raise Fault(f"a block of commands without a marker:\n{body}")
        kind, _, rest = marker.partition(": ")
        if marker:
            yield kind, rest, body


def commands(body):
    """The lines of a block, those that end with a backslash joined, without comments."""
    for line in body.replace("\\\n", " ").splitlines():
        line = re.sub(r"\s+#.*$", "", line).strip()
        if line and not line.startswith("#"):
            yield line


def short(line, settings):
    """A command with the settings of its short form."""
    words = line.split()
    if words[0] == "contrib/render":
        return line + " --frames -1: --size 320x180"
    if words[0] == "./undine" and words[1] != "study" and any(word.endswith(".prm") for word in words):
        return line + "".join(f" --set {shlex.quote(setting.strip())}" for setting in settings.split("|") if setting.strip())
    return line


def has_device(folder):
    return subprocess.run(["./undine", "prm/elastic_sphere.prm", "--validate", "--set", "Particles/Executor=device"], cwd=folder,
                          env=scene_tools.environment(), capture_output=True).returncode == 0


def can_render():
    return (subprocess.run(["/usr/bin/python3", "-c", "import numpy, vtk"], capture_output=True).returncode == 0 and
            bool(shutil.which("Xvfb")))


def mirror(folder, build):
    """What a user finds in the folder of the sources, which stay as they are."""
    for entry in ROOT.iterdir():
        if entry.name not in ("build", "output", "undine", ".git"):
            os.symlink(entry, folder / entry.name)
    launcher = folder / "undine"
    launcher.write_text(LAUNCHER.format(program=pathlib.Path(build, "undine").resolve(), root=ROOT, build=build,
                                        python=sys.executable))
    launcher.chmod(0o755)


def open_for_writing(folder, name, mode):
    """A file in the folder, whose own folders become real ones where they were links into the sources."""
    place = folder
    for part in pathlib.Path(name).parts[:-1]:
        place = place / part
        if place.is_symlink():
            original = place.resolve()
            place.unlink()
            place.mkdir()
            for entry in original.iterdir():
                os.symlink(entry, place / entry.name)
        place.mkdir(exist_ok=True)
    if (folder / name).is_symlink():
        raise Fault(f"'{name}' is a file of the sources: a tutorial leaves them as they are")
    return open(folder / name, mode)


def call(line, folder, code):
    """What a command prints; `python3` is Debian's, as for users, whatever else is on the path."""
    environment = scene_tools.environment()
    environment["PATH"] = "/usr/bin:/bin:" + environment.get("PATH", "")
    result = subprocess.run(["sh", "-c", line], cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            text=True, errors="replace")
    if result.returncode != code:
        raise Fault(f"exit code {result.returncode} of: {line}\n{result.stdout[-3000:]}")
    return result.stdout


def assert_printed(body, printed):
    """The lines of a block stand in what was printed, in the same order; blanks do not count."""
    at, text = 0, re.sub(r"\s+", " ", printed)
    for line in body.splitlines():
        for part in re.split(r"\.\.\.", line):
            part = re.sub(r"\s+", " ", part).strip()
            found = text.find(part, at)
            if found < 0:
                raise Fault(f"not printed: '{part}'\nprinted was:\n{printed[-3000:]}")
            at = found + len(part)


def size_of(folder):
    return sum(entry.lstat().st_size for entry in folder.rglob("*") if entry.is_file() and not entry.is_symlink())


def follow(text, folder, build, full):
    """Do all that the page says."""
    mirror(folder, build)
    pictures, printed = can_render(), ""
    for kind, rest, body in blocks(text):
        if kind in ("file", "more of"):
            with open_for_writing(folder, rest, "w" if kind == "file" else "a") as file:
                file.write(body)
        elif kind == "prints":
            assert_printed(body, printed)
        elif kind in ("run", "on a device") or kind.startswith("fails "):
            printed = ""
            if kind == "on a device" and not has_device(folder):
                print(f"left out, since there is no CUDA device: {body.strip()}")
                continue
            for line in commands(body):
                if line.startswith("contrib/render") and not pictures:
                    print(f"left out, since packages for pictures are missing: {line}")
                    continue
                begin = time.monotonic()
                line = line if full else short(line, rest)
                printed += call(line, folder, int(kind[6:]) if kind.startswith("fails ") else 0)
                print(f"{time.monotonic() - begin:6.1f} s: {line}", flush=True)
        elif kind != "not run":
            raise Fault(f"'<!-- {kind} -->' is no marker")


def assert_costs(text, folder):
    """What the page says of its cost is what it has cost."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    measured = {"core seconds": usage.ru_utime + usage.ru_stime, "memory": usage.ru_maxrss / 1e3, "disk": size_of(folder) / 1e6}
    print({name: round(value, 1) for name, value in measured.items()})
    number, unit, memory, disk = TAKES.search(text).groups()
    said = {"core seconds": float(number) * {"s": 1, "min": 60}[unit], "memory": float(memory), "disk": float(disk)}
    for name, value in measured.items():
        ratio = max(value, LEAST[name]) / max(said[name], LEAST[name])
        if not 1 / FACTOR <= ratio <= FACTOR:
            raise Fault(f"{name}: {value:.3g}, and the page says {said[name]:.3g}")


def main():
    build, page = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])
    text = page.read_text()
    with tempfile.TemporaryDirectory() as folder:
        folder = sys.argv[sys.argv.index("--in") + 1] if "--in" in sys.argv else folder
        os.makedirs(folder, exist_ok=True)
        try:
            if not TAKES.search(text):
                raise Fault(f"no line like '{TAKES.pattern}'")
            follow(text, pathlib.Path(folder), build, "--full" in sys.argv)
            if "--full" in sys.argv:
                assert_costs(text, pathlib.Path(folder))
        except Fault as fault:
            sys.exit(f"{page.name}: {fault}")


if __name__ == "__main__":
    main()
