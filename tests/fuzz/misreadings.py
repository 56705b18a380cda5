# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether what the program accepted means what stands in the scene.

Rests on scene_reader.py, expressions.py and the kinds of keys alone, not on the program's own reading.
"""
import math
import posixpath

import expressions
import scene_reader

ROUNDING = 1e-12  # relative, of an expression's value
VARIABLES = ("x", "y", "z", "t")


def read_case(case):
    """The scene of a case as it stands; nothing is known of one on an odd path."""
    name = posixpath.normpath(case.scene)
    if name not in case.files:
        return scene_reader.Scene({}, [], judged=False)
    return scene_reader.read_scene(case.files, name, case.assignments)


def misreadings(scene, key_types, used=None):
    """What is wrong with accepting this scene. `used`: parameters.json, to compare values with."""
    if not scene.judged:
        return []
    found = [f"accepted although {mistake}" for mistake in scene.mistakes[:1]]
    dim = dimension(scene)
    for path, text in scene.values.items():
        reasons = []
        for kind in sorted(key_types.of(path), key=str):
            try:
                check_value(kind, text, dim, stands_for(used, path))
                reasons = []
                break
            except expressions.Unknown:
                reasons = []
                break
            except expressions.NoExpression as reason:
                reasons.append(str(reason))
        else:
            if not key_types.of(path):
                reasons = ["there is no such key"]
        found += [f"accepted '{short(path)}' = '{short(text)}': {reason}" for reason in reasons[:1]]
    return found


def short(text):
    return text if len(text) <= 60 else text[:60] + "..."


def dimension(scene):
    try:
        return int(expressions.constant(scene.values.get("Dimension", "")) or 0)
    except (expressions.NoExpression, expressions.Unknown, ValueError, OverflowError):
        return 0


def stands_for(used, path):
    """The text in parameters.json, or None."""
    for name in path.split("/"):
        used = used.get(name) if isinstance(used, dict) else None
    return used if isinstance(used, str) else None


def check_value(kind, text, dim, used):
    """Raises NoExpression, saying what is wrong, or Unknown."""
    what, count = kind
    count = dim if count == 3 else count
    if what in ("number", "whole"):
        words = [text] if count == 1 else entries(text)
        if count is not None and len(words) != count:
            raise expressions.NoExpression(f"{len(words)} numbers instead of {count}")
        stands = [None] * len(words) if used is None else entries(used)
        if len(stands) != len(words):
            raise expressions.NoExpression(f"used as '{short(used)}'")
        for word, stand in zip(words, stands):
            check_number(what, word, stand)
        return
    if what == "function":
        expressions.function_of(text, VARIABLES, count)
    if used is not None and entries(used) != entries(text):
        raise expressions.NoExpression(f"used as '{short(used)}'")


def entries(text):
    """Entries of a list; one comma too many at the end loses nothing."""
    words = [word.strip(scene_reader.BLANK) for word in text.split(",")]
    return words[:-1] if not words[-1] else words


def check_number(what, word, stand):
    value = expressions.constant(word)
    if value is None:
        return
    if not math.isfinite(value):
        raise expressions.NoExpression("not a finite number")
    if what == "whole" and value != math.floor(value):
        raise expressions.NoExpression("not a whole number")
    if stand is None:
        return
    exact = bool(expressions.PLAIN.match(word))
    allowed = 0 if exact else ROUNDING * abs(value)
    if not expressions.PLAIN.match(stand) or not abs(float(stand) - value) <= allowed:
        raise expressions.NoExpression(f"used as '{stand}', but is {value!r}")
