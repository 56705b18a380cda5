# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mutations of the text of a scene: values, keys, lines and sections.

Each takes a random generator, the lines of one file, which it changes, and the Stock it may take from.
"""
import dataclasses
import re

import odd_values
import seeds

SECTION = re.compile(r"^(\s*subsection\s+)(.*?)(\s*)$")


@dataclasses.dataclass
class Stock:
    """What occurs in scenes and in the reference of keys."""
    values: list
    assignments: list  # lines 'set KEY = VALUE'
    sections: list  # lists of lines, from 'subsection' to its 'end'
    keys: list  # of all sections and schemes


def make_stock(all_seeds, key_types):
    values, assignments, sections = set(), set(), []
    for seed in all_seeds:
        for name in seed.files:
            if name.endswith((".prm", ".inc")):
                lines = seed.text(name).split("\n")
                for line in lines:
                    match = seeds.ASSIGNMENT.match(line)
                    if match:
                        values.add(match[4])
                        assignments.add(line.strip())
                sections += [lines[begin:end + 1] for begin, end in sections_of(lines)]
    keys = sorted({key for _, key in key_types.all_keys()})
    return Stock(sorted(values), sorted(assignments), sections, keys)


def sections_of(lines):
    """Pairs (line of 'subsection', line of its 'end')."""
    open_sections, found = [], []
    for number, line in enumerate(lines):
        words = line.split("#")[0].split()
        if words[:1] == ["subsection"]:
            open_sections.append(number)
        elif words == ["end"] and open_sections:
            found.append((open_sections.pop(), number))
    return found


def settings_of(lines):
    return [number for number, line in enumerate(lines) if seeds.ASSIGNMENT.match(line)]


def any_line(rng, lines):
    """A line that says something, if there is one."""
    telling = [number for number, line in enumerate(lines) if line.split("#")[0].strip()]
    return rng.choice(telling) if telling else rng.randrange(len(lines))


def value(rng, lines, stock):
    number = rng.choice(settings_of(lines))
    head, key, equals, old, rest = seeds.ASSIGNMENT.match(lines[number]).groups()
    lines[number] = head + key + equals + odd_values.changed_value(rng, old, stock.values) + rest


def key(rng, lines, stock):
    number = rng.choice(settings_of(lines))
    head, old, equals, text, rest = seeds.ASSIGNMENT.match(lines[number]).groups()
    new = rng.choice((misspelt(rng, old), misspelt(rng, old), rng.choice(stock.keys), old.lower(), old.upper(),
                      old.replace(" ", ""), old.replace(" ", "  "), "Time/" + old, "", old + " " + old,
                      rng.choice(odd_values.NAMES)))
    lines[number] = head + new + equals + text + rest


def misspelt(rng, word):
    if len(word) < 2:
        return word + "x"
    at = rng.randrange(len(word) - 1)
    return rng.choice((word[:at] + word[at + 1:], word[:at] + word[at] + word[at:],
                       word[:at] + word[at + 1] + word[at] + word[at + 2:], word[:at] + "e" + word[at + 1:]))


def new_setting(rng, lines, stock):
    """A key from the reference or a line of another scene, anywhere."""
    known = f"set {rng.choice(stock.keys)} = {odd_values.changed_value(rng, '1', stock.values)}"
    lines.insert(rng.randrange(len(lines) + 1), rng.choice((known, rng.choice(stock.assignments))))


def deleted_line(rng, lines, stock):
    del lines[any_line(rng, lines)]


def doubled_line(rng, lines, stock):
    number = any_line(rng, lines)
    lines.insert(rng.choice((number, rng.randrange(len(lines) + 1))), lines[number])


def moved_line(rng, lines, stock):
    line = lines.pop(any_line(rng, lines))
    lines.insert(rng.randrange(len(lines) + 1), line)


def cut_line(rng, lines, stock):
    """Ended early, broken in two, or joined with the next."""
    number = any_line(rng, lines)
    at = rng.randrange(len(lines[number]) + 1)
    first, second = lines[number][:at], lines[number][at:]
    lines[number:number + 1] = rng.choice(([first], [first, second], [first + "\\", second], [lines[number] + "\\"],
                                           [first + "#" + second], [first + " \\#" + second]))


def ends(rng, lines, stock):
    numbers = [number for number, line in enumerate(lines) if line.split("#")[0].split() == ["end"]]
    if numbers and rng.random() < 0.5:
        del lines[rng.choice(numbers)]
    else:
        lines.insert(rng.randrange(len(lines) + 1), rng.choice(("end", "end end", "END", "end # of it", "end;", "ends")))


def nonsense(rng, lines, stock):
    lines.insert(rng.randrange(len(lines) + 1), rng.choice((
        "set", "set ", "set =", "set = 1", "set a", "subsection", "subsection ", "include", "include ", "Set a = 1", "\\",
        "subsection a/b", "set a/b = 1", "seta = 1", "set\ta\t=\t1", "set a == 1", "set a = b = c", "}", "<!-- -->", "\x00",
        "[Time]", "Time.End = 1", "set a : 1", "set Dimension = 3", "set Scheme = particle", "set Folder of files = /")))


def section_name(rng, lines, stock):
    """Renamed everywhere in the file, or only where it begins."""
    numbers = [number for number, line in enumerate(lines) if SECTION.match(line)]
    number = rng.choice(numbers)
    head, old, rest = SECTION.match(lines[number]).groups()
    old = old.split("#")[0].strip()
    new = rng.choice((rng.choice(odd_values.NAMES), rng.choice(odd_values.NAMES), misspelt(rng, old)))
    lines[number] = head + new
    if rng.random() < 0.6 and old:
        for at, line in enumerate(lines):
            match = seeds.ASSIGNMENT.match(line)
            if match and match[4] == old:
                lines[at] = "".join(match.groups()[:3]) + new + match[5]


def section(rng, lines, stock):
    """Deleted, doubled, emptied, moved, nested or exchanged for one of another scene."""
    begin, end = rng.choice(sections_of(lines))
    whole = lines[begin:end + 1]
    other = rng.choice(stock.sections)
    lines[begin:end + 1] = rng.choice((
        [], whole + whole, [whole[0], whole[-1]], ["subsection a", *whole, "end"], whole[1:-1], other, whole + other,
        [whole[0], *other, *whole[1:]], [whole[0], *whole, whole[-1]]))


def moved_section(rng, lines, stock):
    begin, end = rng.choice(sections_of(lines))
    whole = lines[begin:end + 1]
    del lines[begin:end + 1]
    at = rng.randrange(len(lines) + 1)
    lines[at:at] = whole


def body_of_another_scene(rng, lines, stock):
    """A section of a body, obstacle, boundary or probe beside one of this scene."""
    inner = [pair for pair in sections_of(lines) if lines[pair[0]].startswith(" ")]
    begin, _ = rng.choice(inner)
    lines[begin:begin] = rng.choice(stock.sections)


MUTATIONS = {  # name: (function, weight)
    "value": (value, 30), "key": (key, 8), "new setting": (new_setting, 6), "deleted line": (deleted_line, 6),
    "doubled line": (doubled_line, 3), "moved line": (moved_line, 4), "cut line": (cut_line, 4), "ends": (ends, 3),
    "nonsense": (nonsense, 4), "section name": (section_name, 8), "section": (section, 8),
    "moved section": (moved_section, 3), "body of another scene": (body_of_another_scene, 4)}
