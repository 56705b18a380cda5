# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes as nested dictionaries: sections are dictionaries, values of keys are texts."""
import copy
import os
import re

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(HERE)))
SCENES = os.path.join(HERE, "scenes")

# Nothing but rows of numbers is written.
QUIET = {"Output/Parts": "statistics", "Output/Interval": "0"}


def read(path):
    """A file without `include`; names of meshes stay relative to its folder."""
    with open(path) as file:
        text = re.sub(r"\\\n", " ", file.read())
    scene, open_sections = {}, []
    for line in text.splitlines():
        line = line.partition("#")[0].strip()
        inside = section(scene, open_sections)
        if line.startswith("subsection "):
            open_sections.append(line[len("subsection "):].strip())
            section(inside, open_sections[-1:])
        elif line == "end":
            open_sections.pop()
        elif line:
            key, _, value = line[len("set "):].partition("=")
            inside[key.strip()] = value.strip()
    scene["Folder of files"] = os.path.dirname(os.path.abspath(path))
    return scene


def section(scene, names):
    """The section below `scene`, which comes to be if it is not there."""
    for name in names:
        scene = scene.setdefault(name, {})
    return scene


def with_settings(scene, *settings):
    """A copy in which keys have other values; each of `settings` is {"Section/Key": value}, with None for what is to
    be removed and {} for an empty section."""
    result = copy.deepcopy(scene)
    for pairs in settings:
        for path, value in pairs.items():
            *names, key = path.split("/")
            inside = section(result, names)
            if value is None:
                inside.pop(key, None)
            else:
                inside[key] = value if isinstance(value, dict) else str(value)
    return result


def text(scene, indent=""):
    """What `read` reads."""
    lines = []
    for key, value in scene.items():
        if isinstance(value, dict):
            lines += [f"{indent}subsection {key}\n", text(value, indent + "  "), f"{indent}end\n"]
        else:
            lines.append(f"{indent}set {key} = {value}\n")
    return "".join(lines)


def value_of(scene, path):
    *names, key = path.split("/")
    return section(scene, names)[key]


def point(numbers):
    """How a place is written in a scene, to the bit."""
    return ", ".join(repr(float(number)) for number in numbers)
