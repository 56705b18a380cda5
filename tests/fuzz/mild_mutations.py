# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mutations that make other scenes rather than wrong ones: most of them are accepted, and run.

Each takes a random generator, the lines of one file, which it changes, and the Stock it may take from.
"""
import dataclasses
import re

import expressions
import seeds

FACTORS = ("0.1", "0.3", "0.9", "1.1", "2", "5", "-1", "1e3", "1e-3", "1e6", "0")


@dataclasses.dataclass
class Stock:
    """What keys and sections scenes have."""
    values: dict  # key -> values that it has in some scene
    sections: dict  # path of a section -> lists of lines that stand in it
    options: dict  # section, '*' for any name -> [(key, a value that it may have)]


def walk(lines):
    """For each line its number and the sections that are open before it."""
    open_sections = []
    for number, line in enumerate(lines):
        words = line.split("#")[0].split()
        if words == ["end"] and open_sections:
            yield number, tuple(open_sections[:-1])
            open_sections.pop()
            continue
        yield number, tuple(open_sections)
        if words[:1] == ["subsection"]:
            open_sections.append(" ".join(words[1:]))


def make_stock(all_seeds, key_types):
    values, sections = {}, {}
    for seed in all_seeds:
        lines = seed.text(seed.scene).split("\n")
        begins = {}
        for number, path in walk(lines):
            match = seeds.ASSIGNMENT.match(lines[number])
            if match:
                values.setdefault(match[2], set()).add(match[4])
            words = lines[number].split("#")[0].split()
            if words[:1] == ["subsection"]:
                begins[path] = number
            elif words == ["end"] and path in begins:
                sections.setdefault(path, []).append(lines[begins.pop(path):number + 1])
    return Stock({key: sorted(found) for key, found in values.items()}, sections, key_types.options)


def change_setting(rng, lines, change):
    """`change(key, value)` gives the new value of one setting."""
    numbers = [number for number, line in enumerate(lines) if seeds.ASSIGNMENT.match(line)]
    number = rng.choice(numbers)
    head, key, equals, value, rest = seeds.ASSIGNMENT.match(lines[number]).groups()
    lines[number] = head + key + equals + change(key, value) + rest


def value_of_another_scene(rng, lines, stock):
    change_setting(rng, lines, lambda key, value: rng.choice(stock.values.get(key, [value])))


def scaled_value(rng, lines, stock):
    def change(key, value):
        words = re.split(r"([,;]\s*)", value)
        at = 2 * rng.randrange((len(words) + 1) // 2)
        if key in ("Cells", "Refinements", "Spacing"):
            return value
        if expressions.PLAIN.match(words[at]):
            words[at] = f"{float(words[at]) * float(rng.choice(FACTORS)):.6g}"
        return "".join(words)
    change_setting(rng, lines, change)


def option_of_a_section(rng, lines, stock):
    """A key that the section may have, with its default or one of its words."""
    places = [(number, matching(stock.options, path)) for number, path in walk(lines) if
              seeds.ASSIGNMENT.match(lines[number])]
    number, options = rng.choice([place for place in places if place[1]])
    key, value = rng.choice(options)
    lines.insert(number, f"set {key} = {value}")


def matching(options, path):
    return [option for section, found in options.items() if len(section) == len(path) and
            all(expected in (None, name) for expected, name in zip(section, path)) for option in found]


def part_of_another_scene(rng, lines, stock):
    """An effect, a body, an obstacle, a probe or a boundary, where such a thing may stand."""
    places = [(number, path) for number, path in walk(lines) if path and path in stock.sections and
              lines[number].split("#")[0].split()[:1] == ["subsection"]]
    number, path = rng.choice(places)
    part = list(rng.choice(stock.sections[path]))
    if rng.random() < 0.5 and path[0] in ("Bodies", "Obstacles", "Probes"):
        part[0] += " 2"
    lines[number:number] = part


def without_part(rng, lines, stock):
    """A part less, of those with a name."""
    inner = [(path, number) for number, path in walk(lines) if len(path) >= 1 and
             lines[number].split("#")[0].split()[:1] == ["subsection"]]
    path, begin = rng.choice(inner)
    end = next(number for number, above in walk(lines) if number > begin and above == path and
               lines[number].split("#")[0].split() == ["end"])
    del lines[begin:end + 1]


MUTATIONS = {  # name: (function, weight)
    "value of another scene": (value_of_another_scene, 6), "scaled value": (scaled_value, 10),
    "option of a section": (option_of_a_section, 8), "part of another scene": (part_of_another_scene, 4),
    "without part": (without_part, 2)}
