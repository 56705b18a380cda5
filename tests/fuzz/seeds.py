# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scenes that are mutated, made small, with all files that they need."""
import copy
import dataclasses
import os
import pathlib
import posixpath
import re
import shutil

import expressions
import scene_reader

FOLDERS = ("prm", "tests/malformed", "tests/resume")
ASSIGNMENT = re.compile(r"^(\s*set\s+)([^=\n]*?)(\s*=[ \t]*)([^#\n]*?)(\s*(?:#.*)?)$")
# So many cells of the domain and of a body, and particles, are enough.
MOST_CELLS, MOST_BODY_CELLS, MOST_PARTICLES = 300, 16, 400


@dataclasses.dataclass
class Case:
    """Files in a folder, and the words with which the program is called there."""
    files: dict  # name -> bytes
    scene: str  # the file that is run
    assignments: list  # what --set is given
    words: list  # other words of the command line
    output: str = "results"
    seed: str = ""  # the scene it comes from
    mutations: list = dataclasses.field(default_factory=list)
    folders: list = dataclasses.field(default_factory=list)
    equivalent: bool = False  # only edits that must not change anything

    def text(self, name):
        return scene_reader.decode(self.files[name])

    def set_text(self, name, text):
        self.files[name] = scene_reader.encode(text)

    def copy(self):
        return copy.deepcopy(self)

    def write(self, folder):
        """Into an empty folder, which is made."""
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for name in self.folders:
            (folder / name).mkdir(parents=True, exist_ok=True)
        for name, data in self.files.items():
            path = folder / os.fsdecode(scene_reader.encode(name))
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)

    def validation(self):
        """Arguments of the program."""
        return [self.scene, *self.settings(), *self.words, "--validate"]

    def run(self, steps, output):
        return [self.scene, *self.settings(), *self.words, "--set", f"Time/Maximum steps={steps}",
                "--output", output]

    def results(self):
        """The folder that `output` means, also if folders on its path do not exist: 'b' for 'a/../b'."""
        return posixpath.normpath(self.output)

    def settings(self):
        return [word for assignment in self.assignments for word in ("--set", assignment)]


def scenes_of(root):
    """All scenes in the repository, sorted."""
    return sorted(path for folder in FOLDERS for path in (root / folder).glob("*.prm"))


def read_seed(root, path):
    """A scene and the files that it names, in a tree of folders like that of the repository."""
    case = Case({}, path.relative_to(root).as_posix(), [], [], seed=path.relative_to(root).as_posix())
    waiting = [path]
    while waiting:
        file = waiting.pop()
        name = file.relative_to(root).as_posix()
        if name in case.files:
            continue
        data = file.read_bytes()
        case.files[name] = data
        if file.suffix in (".prm", ".inc"):
            for found in re.findall(r"^\s*(?:include|set [^=\n]*=)\s+([^#\n]*\.\w+)\s*(?:#.*)?$", data.decode(), re.M):
                mentioned = pathlib.Path(os.path.normpath(file.parent / found.strip()))
                if mentioned.is_file():
                    waiting.append(mentioned)
    flatten(case)
    for name in list(case.files):
        if name.endswith((".prm", ".inc")):
            case.set_text(name, small(case.text(name)))
    return case


def flatten(case):
    """All files into one folder; the names of files differ anyway."""
    case.scene = pathlib.PurePath(case.scene).name
    case.files = {pathlib.PurePath(name).name: data for name, data in case.files.items()}
    for name in case.files:
        if name.endswith((".prm", ".inc")):
            case.set_text(name, re.sub(r"^(\s*include\s+)\S*/", r"\1", case.text(name), flags=re.M))


def small(text):
    """The same scene with fewer cells or particles."""
    sections, result, corners = [], [], {}
    for line in text.split("\n"):
        match = ASSIGNMENT.match(line)
        words = line.split("#")[0].split()
        if words[:1] == ["subsection"]:
            sections.append(" ".join(words[1:]))
        elif words == ["end"] and sections:
            sections.pop()
        elif match:
            head, key, equals, value, rest = match.groups()
            if key.strip() in ("Lower corner", "Upper corner") and sections == ["Domain"]:
                corners[key.strip()] = value
            line = head + key + equals + small_value(sections, key.strip(), value) + rest
        result.append(line)
    return coarser_particles("\n".join(result), corners)


def small_value(sections, key, value):
    if key == "Cells" and re.fullmatch(r"[\d, ]+", value):
        most = MOST_CELLS if sections == ["Domain"] else MOST_BODY_CELLS
        cells = [int(word) for word in value.split(",") if word.strip()]
        while product(cells) > most:
            cells[cells.index(max(cells))] = (max(cells) + 1) // 2
        return ", ".join(map(str, cells))
    if key == "Refinements" and value.isdigit():
        return str(min(1, int(value)))
    return value


def product(numbers):
    result = 1
    for number in numbers:
        result *= number
    return result


def coarser_particles(text, corners):
    """Multiply the spacing of particles by the largest number with which it still divides the domain's edges; one thread,
    since several cases run at a time."""
    if "set Threads" not in text:
        text = re.sub(r"^(\s*)(subsection Particles[ \t]*\n)", r"\1\2\1  set Threads = 1\n", text, flags=re.M)
    match = re.search(r"^(\s*set\s+Spacing\s*=\s*)([^#\n]+?)\s*$", text, re.M)
    if not match or len(corners) != 2:
        return text
    try:
        spacing = expressions.constant(match[2])
        lower, upper = ([expressions.constant(word.strip()) for word in corners[key].split(",")]
                        for key in ("Lower corner", "Upper corner"))
    except (expressions.NoExpression, expressions.Unknown):
        return text
    edges = [b - a for a, b in zip(lower, upper)]
    if not spacing or not min(edges, default=0) > 0:
        return text
    for factor in (2, 3, 4, 5, 6, 8, 10):
        if product([edge / (spacing * factor) for edge in edges]) < MOST_PARTICLES / 2:
            break
        if all(abs(edge / (spacing * factor) - round(edge / (spacing * factor))) < 1e-6 for edge in edges):
            best = factor
            text = text[:match.start()] + f"{match[1]}({match[2]})*{best}" + text[match.end():]
            match = re.search(r"^(\s*set\s+Spacing\s*=\s*)\((.+?)\)\*\d+\s*$", text, re.M)
    return text


def read_seeds(root):
    return [read_seed(root, path) for path in scenes_of(root)]
