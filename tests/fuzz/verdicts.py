# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is wrong with the program's answer to one start: pairs (verdict, detail).

Details do not depend on the case as far as possible, so that they tell mistakes of the program apart.
"""
import posixpath
import re
import signal

import file_mutations

DOCUMENTED = {0, 2, 3, 4, 6, 7}  # exit codes; 7 only for a run that was asked to stop
ONE_RANK = "particles are computed by one rank"
CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f]")
PLACE = re.compile(r"^(?:Error: )?(?P<file>.+?):(?P<line>\d+): (?:section '.*?'|top level), key '(?P<key>[^']*)'", re.M)
# Every scene may have these sections.
FALSE_MISTAKE = re.compile(r"top level, subsection '(?:Time|Fluid|Bodies|Effects|Output|Probes)': there is no such")
LINES_BEFORE = 30  # of a continued line, whose place is its last line

KINDS = ("crash", "unexpected condition", "exit code", "timeout", "memory", "not finite", "unclear message",
         "wrong place", "false mistake", "quotes a foreign file", "broken file", "misread", "not repeatable", "resume differs",
         "ranks differ", "validate and run differ", "equivalent differs", "wrote elsewhere")


def of_end(result):
    """From the exit code and the limits."""
    if result.hung:
        return [("timeout", "no end" if not result.too_long else "no end, neither by itself nor by a signal")]
    if result.too_large:
        return [("memory", "more than allowed")]
    number = -result.code if result.code < 0 else result.code - 128
    if result.asked_by and number == result.asked_by:
        return []  # before it listened to signals
    if result.code < 0 or 1 <= number <= 64:
        name = signal.Signals(number).name if number in set(signal.Signals) else str(number)
        return [("crash", name)]
    if result.code == 5:
        text = result.err.partition("unexpected condition")[2].split("\n")
        return [("unexpected condition", plain(" ".join(text[1:4])))]
    if result.code not in DOCUMENTED or result.code == 7 and not result.too_long:
        return [("exit code", f"{result.code}: {plain(result.err)}")]
    return []


def of_particles(case, result):
    """From an answer to particles on several ranks: they are refused, with the reason."""
    found = of_end(result) + of_message(case, result)
    if not found and (result.code != 2 or ONE_RANK not in result.err):
        found = [("ranks differ", f"particles on several ranks: exit code {result.code}: {plain(result.err)}")]
    return found


def plain(text):
    """Without what differs from case to case: numbers and what is quoted."""
    text = re.sub(r"'[^']*'|\"[^\"]*\"", "'...'", text)
    return re.sub(r"\d[\d.e+-]*", "0", text).strip()[:150]


def of_message(case, result):
    """Whoever reads an error must learn what it is about, and nothing that is not his."""
    found = []
    if file_mutations.SECRET in result.out + result.err:
        found.append(("quotes a foreign file", plain(line_with(result.out + result.err, file_mutations.SECRET))))
    if result.code in (2, 3, 4, 6) and not result.err.strip():
        found.append(("unclear message", f"none, exit code {result.code}"))
    elif result.code in (2, 4) and not names_a_place(case, result.err):
        found.append(("unclear message", f"names no place: {plain(result.err)}"))
    if result.code in (2, 4) and CONTROL.search(result.err):
        found.append(("unclear message", "contains control characters"))
    if FALSE_MISTAKE.search(result.err):
        found.append(("false mistake", plain(FALSE_MISTAKE.search(result.err)[0].replace("'", ""))))
    return found + wrong_places(case, result.err)


def line_with(text, word):
    line = next(line for line in text.split("\n") if word in line)
    return line.replace(word, "SECRET")


def names_a_place(case, message):
    words = [*case.files, case.scene, case.output, "command line", "section '", "key '", "top level", "--"]
    return any(word in message for word in words)


def legible(text):
    """What is left of a scene's text where it and a message can be compared: without blanks, line breaks and
    their backslashes, and whatever messages show as '?' or, as a byte that is no text, by its number."""
    return re.sub(r"\\x[0-9a-f]{2}|[^!->@-\[\]-~]", "", text)


def wrong_places(case, message):
    """The line that an error names must have the key that it names."""
    for match in PLACE.finditer(message):
        name = posixpath.normpath(match["file"])
        if name in case.files:
            number = int(match["line"])
            lines = case.text(name).split("\n")[max(0, number - LINES_BEFORE):number]
            if legible(match["key"]) not in legible("".join(lines)):
                return [("wrong place", plain(match[0]))]
    return []
