# SPDX-License-Identifier: LGPL-2.1-or-later
"""What kind of value each key takes, from what `undine --reference` prints."""
import re


class KeyTypes:
    """Sections of the reference; `<name>` in them stands for any name."""

    def __init__(self, reference):
        self.sections = {}  # ("Bodies", None) -> {key: set of types}
        self.options = {}  # the same -> pairs (key, a value that it may have)
        section, names = None, ()
        for line in reference.splitlines():
            if line.startswith("## "):
                title = line[3:].replace("\\", "").strip()
                names = () if title == "Top level" else tuple(
                    None if re.fullmatch("<.*>", name) else name for name in title.split(" / "))
                section = self.sections.setdefault(names, {})
            elif line.startswith("| ") and section is not None and not line.startswith("| key |"):
                cells = [cell.strip().replace("\\", "") for cell in re.split(r"(?<!\\)\|", line)[1:]]
                section.setdefault(cells[0], set()).add(kind_of(cells[2]))
                self.options.setdefault(names, []).extend((cells[0], value) for value in values_of(cells[1], cells[2]))

    def of(self, path):
        """The kinds that the key of `path` may have, by schemes and conditions; empty if there is no such key."""
        *names, key = path.split("/")
        found = set()
        for section, keys in self.sections.items():
            if len(section) == len(names) and key in keys and all(
                    expected in (None, name) for expected, name in zip(section, names)):
                found |= keys[key]
        return found

    def all_keys(self):
        """Sorted pairs (section with '*' for any name, key)."""
        return sorted(("/".join("*" if name is None else name for name in section), key)
                      for section, keys in self.sections.items() for key in keys)


def values_of(default, allowed):
    """Values that are allowed, as far as the reference names them."""
    words = [word.strip() for word in allowed.removeprefix("list of words, ").split(" | ")]
    if len(words) > 1:
        return words
    return [] if default.startswith("*") else [default]


def kind_of(allowed):
    """(what, how many or variables): ("number", 1), ("whole", 3), ("numbers", None), ("function", (2, "x, y, t")),
    ("text", None)."""
    if re.match(r"number\b", allowed):
        return "number", 1
    if re.match(r"whole number\b", allowed):
        return "whole", 1
    several = re.match(r"(\d) (whole )?numbers\b", allowed)
    if several:
        return ("whole" if several[2] else "number"), int(several[1])
    if allowed.startswith("list of numbers"):
        return "number", None
    function = re.match(r"(?:expression|(\d) expressions .*?) in ([xyzt, ]+)", allowed)
    if function:
        return "function", int(function[1] or 1)
    return "text", None
