# SPDX-License-Identifier: LGPL-2.1-or-later
"""The smallest case that shows the same fault: first files and words go, then lines, then parts of lines."""
import re

MOST_TRIALS = 400


class Minimiser:
    """`shows(case)` says whether a case still has the fault."""

    def __init__(self, shows, most_trials=MOST_TRIALS):
        self.shows = shows
        self.left = most_trials

    def still(self, case):
        if self.left <= 0:
            return False
        self.left -= 1
        return self.shows(case)

    def minimise(self, case):
        case = self.without_words(case)
        case = self.without_files(case)
        size = None
        while size != weight(case) and self.left > 0:
            size = weight(case)
            for name in sorted(case.files, key=lambda name: (name != case.scene, name)):
                case = self.shorter(case, name, lambda text: text.split("\n"), "\n".join)
            for name in sorted(case.files, key=lambda name: (name != case.scene, name)):
                case = self.shorter(case, name, lambda text: re.split(r"(?<=[\s,;=()])", text), "".join)
            case = self.shorter_values(case)
        return case

    def without_words(self, case):
        for field in ("assignments", "words", "folders"):
            entries = self.reduced(getattr(case, field), lambda kept: changed(case, field, kept))
            case = changed(case, field, entries)
        for simple in ("results",):
            other = changed(case, "output", simple)
            if case.output != simple and self.still(other):
                case = other
        return case

    def without_files(self, case):
        others = sorted(name for name in case.files if name != case.scene)
        kept = self.reduced(others, lambda names: with_files(case, names))
        return with_files(case, kept)

    def shorter(self, case, name, split, join):
        """Fewer parts of one file."""
        def with_parts(parts):
            other = case.copy()
            other.set_text(name, join(parts))
            return other
        return with_parts(self.reduced(split(case.text(name)), with_parts))

    def shorter_values(self, case):
        """Halves of words that are long."""
        for name in sorted(case.files):
            for word in set(re.findall(r"\S{40,}", case.text(name))):
                while len(word) > 20:
                    other = case.copy()
                    other.set_text(name, case.text(name).replace(word, word[:len(word) // 2]))
                    if not self.still(other):
                        break
                    case, word = other, word[:len(word) // 2]
        return case

    def reduced(self, parts, make):
        """Delta debugging: remove blocks of parts, of half of them down to one."""
        block = max(1, len(parts) // 2)
        while block >= 1 and parts:
            at = 0
            while at < len(parts) and self.left > 0:
                fewer = parts[:at] + parts[at + block:]
                if self.still(make(fewer)):
                    parts = fewer
                else:
                    at += block
            block = block // 2 if self.left > 0 else 0
        return parts


def changed(case, field, value):
    other = case.copy()
    setattr(other, field, value)
    return other


def with_files(case, names):
    other = case.copy()
    other.files = {name: data for name, data in case.files.items() if name == case.scene or name in names}
    return other


def weight(case):
    return sum(len(data) for data in case.files.values())
