# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes read once more, independently of the program, from what is documented of their syntax.

What the program accepts must be what stands here: the same values, and no mistakes.
"""
import dataclasses
import re

BLANK = " \t\n\v\f\r"
MOST_LINES = 200000  # of all files: what is longer is not judged


@dataclasses.dataclass
class Scene:
    """The assignments of a scene."""
    values: dict  # "Section/Key" -> text
    mistakes: list  # texts: what must not be accepted
    judged: bool = True  # False if it is too long to be read here


def encode(text):
    return text.encode("utf-8", "surrogateescape")


def decode(data):
    """Text whose encode() is `data`, whatever its bytes."""
    return data.decode("utf-8", "surrogateescape")


def odd_backslashes_end(text):
    return (len(text) - len(text.rstrip("\\"))) % 2 == 1


def without_comment(line):
    """The line before the first '#' that no backslash protects."""
    at = line.find("#")
    while at >= 0 and odd_backslashes_end(line[:at]):
        at = line.find("#", at + 1)
    return (line if at < 0 else line[:at]).strip(BLANK)


def logical_lines(text):
    """Lines without comments and blanks, continued ones joined."""
    lines = text.split("\n")
    at = 0
    while at < len(lines):
        line = without_comment(lines[at])
        while odd_backslashes_end(line) and at + 1 < len(lines):
            at += 1
            line = line[:-1] + " " + without_comment(lines[at])
        yield line
        at += 1


class Reader:
    """Reads the files of a case, a dictionary of names and bytes."""

    def __init__(self, files):
        self.files = files
        self.scene = Scene({}, [])
        self.file_of = {}  # path -> the file that assigned it
        self.open = []
        self.n_lines = 0

    def mistake(self, name, what):
        self.scene.mistakes.append(f"{name}: {what}")

    def read(self, name, sections=()):
        if name not in self.files:
            return self.mistake(name, "the included file does not exist")
        if name in self.open:
            return self.mistake(name, "includes itself")
        self.open.append(name)
        inside = list(sections)
        for line in logical_lines(decode(self.files[name]).removeprefix("\ufeff")):
            self.n_lines += 1
            if self.n_lines > MOST_LINES:
                self.scene.judged = False
            if not self.scene.judged:
                return None
            if line == "end" and len(inside) == len(sections):
                self.mistake(name, "'end' without an open subsection")
            elif line:
                self.line(name, line, inside)
        if len(inside) != len(sections):
            self.mistake(name, "an 'end' is missing")
        self.open.pop()
        return None

    def line(self, name, line, sections):
        word, _, rest = re.sub(f"[{BLANK}]", " ", line, count=1).partition(" ")
        rest = rest.strip(BLANK)
        if line == "end":
            sections.pop()
        elif word == "subsection" and rest:
            sections.append(rest)
            if "/" in rest:
                self.mistake(name, "'/' in the name of a subsection")
        elif word == "include" and rest:
            folder = name.rpartition("/")[0]
            self.read(f"{folder}/{rest}" if folder else rest, tuple(sections))
        elif word == "set" and "=" in rest:
            key, _, value = rest.partition("=")
            self.assign(name, "/".join([*sections, key.strip(BLANK)]), value)
        else:
            self.mistake(name, f"a line that is no command: {line[:60]!r}")

    def assign(self, name, path, value):
        if not path.rpartition("/")[2]:
            self.mistake(name, "an assignment without a key")
        if self.file_of.get(path) == name:
            self.mistake(name, f"{path!r} is set twice")
        self.file_of[path] = name
        self.scene.values[path] = re.sub(r"\\([\\#])", r"\1", value.strip(BLANK))


def read_scene(files, name, assignments=()):
    """The scene `name` of `files`, with what `--set` says."""
    reader = Reader(files)
    reader.read(name)
    for assignment in assignments:
        path, equals, value = assignment.partition("=")
        path = path.strip(BLANK)
        if not equals or "" in [part.strip(BLANK) for part in path.split("/")]:
            reader.mistake("command line", "an assignment without the form Section/Key=value")
        reader.scene.values[path] = value.strip(BLANK)
    return reader.scene
