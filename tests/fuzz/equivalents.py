# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edits of a scene that must not change anything: the program has to answer as it does without them.

Each takes a random generator, the case and the kinds of keys.
"""
import re

import expressions
import file_mutations
import scene_mutations
import seeds


def scene_files(case):
    return sorted(name for name in case.files if name.endswith((".prm", ".inc")))


def each_line(rng, case, change):
    """Some lines that are not part of a continued one, changed."""
    for name in scene_files(case):
        lines = case.text(name).split("\n")
        if not any(line.rstrip().endswith("\\") for line in lines):
            case.set_text(name, "\n".join(change(line) if rng.random() < 0.4 else line for line in lines))


def comments(rng, case, key_types):
    each_line(rng, case, lambda line: line + rng.choice(("  # set End = 7", " # é \"<&>\\", "#", "\n# end", " # a \\# b")))


def blanks(rng, case, key_types):
    def change(line):
        match = re.match(r"(\s*)(\S+)(\s+)(.*)", line)
        if not match or match[2] not in ("set", "subsection", "include"):
            return rng.choice(("", "  ", "\t")) + line + rng.choice(("", "  ", "\t", "\n", "\n\n \n"))
        return rng.choice(("", "\t", "        ")) + match[2] + rng.choice((" ", "  ", "\t")) + match[4] + "  \t"
    each_line(rng, case, change)


def around_equals(rng, case, key_types):
    def change(line):
        match = seeds.ASSIGNMENT.match(line)
        if not match:
            return line
        head, key, _, value, rest = match.groups()
        return head + key + rng.choice(("=", " = ", "\t=\t", "   =", " = \\\n", " \\\n = ")) + value + rest
    each_line(rng, case, change)


def encoding(rng, case, key_types):
    for name in scene_files(case):
        data = case.files[name]
        case.files[name] = rng.choice((
            data.replace(b"\n", b"\r\n"), file_mutations.MARK + data, data.rstrip(b"\n"), data + b"\n\n# the end",
            file_mutations.MARK + data.replace(b"\n", b"\r\n")))


def numbers(rng, case, key_types):
    """Written otherwise, with the same value to the bit."""
    for name in scene_files(case):
        sections, lines = [], case.text(name).split("\n")
        included = name != case.scene
        for at, line in enumerate(lines):
            said = line.split("#")[0].split()
            if said[:1] == ["subsection"]:
                sections.append(" ".join(said[1:]))
            elif said == ["end"] and sections:
                sections.pop()
            match = seeds.ASSIGNMENT.match(line)
            if not match or "\\" in match[4] or included and not sections:
                continue
            head, key, equals, value, rest = match.groups()
            kinds = key_types.of("/".join([*sections, key.strip()]))
            if kinds and all(kind in ("number", "whole") for kind, _ in kinds):
                lines[at] = head + key + equals + ", ".join(
                    respelt(rng, word.strip()) for word in value.split(",")) + rest
        case.set_text(name, "\n".join(lines))


def respelt(rng, word):
    if not expressions.PLAIN.match(word):
        return f"({word})" if word and "(" not in word and "," not in word else word
    value = float(word)
    return rng.choice((word, repr(value), f"{value:.17e}", f"{value:.17g}", f"({word})", f"{word}*1", f"{word}/1",
                       f"0+{word}" if not word.startswith("-") else word, word + "0" if "." in word and
                       "e" not in word.lower() else word))


def piece_included(rng, case, key_types):
    """A whole section goes to a file of its own."""
    lines = case.text(case.scene).split("\n")
    pairs = scene_mutations.sections_of(lines)
    if pairs:
        begin, end = rng.choice(pairs)
        case.set_text("piece.inc", "\n".join(lines[begin:end + 1]) + "\n")
        lines[begin:end + 1] = ["include piece.inc"]
        case.set_text(case.scene, "\n".join(lines))


def value_by_command_line(rng, case, key_types):
    """A value of the scene is given by --set as well."""
    lines = case.text(case.scene).split("\n")
    top = []
    for line in lines:
        match = seeds.ASSIGNMENT.match(line)
        if line.split()[:1] == ["subsection"]:
            break
        if match and "\\" not in match[4]:
            top.append(f"{match[2]}={match[4]}")
    if top:
        case.assignments.append(rng.choice(top))


LAST = "encoding"  # a byte-order mark stays in front, a carriage return at the end
EDITS = {"comments": comments, "blanks": blanks, "around equals": around_equals, "encoding": encoding, "numbers": numbers,
         "piece included": piece_included, "value by command line": value_by_command_line}
