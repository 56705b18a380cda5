# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes as texts: what they consist of, and what is left of one without some of its keys."""
import hashlib
import os
import re


def without_comment(line):
    """A '#' after an odd number of backslashes is a part of the value."""
    return re.match(r"(?:[^#\\]|\\.)*\\?", line.rstrip("\n"))[0].strip()


def is_continued(line):
    return (len(line) - len(line.rstrip("\\"))) % 2 == 1


def blocks(file):
    """Lines of a parameter file, each with those that continue it."""
    block = ""
    with open(file, errors="replace") as stream:
        for line in stream:
            block += line
            if not is_continued(without_comment(line)):
                yield block.rstrip("\n") + "\n"
                block = ""


def parts_of(file, sections):
    """Of each part of a file its text, its first word, what stands after that and, where it sets one, the "Section/Key"."""
    sections = list(sections)
    for block in blocks(file):
        found = re.match(r"\s*(subsection|set|include|end)\b([^=#\n]*)", block)
        word, rest = (found[1], found[2].strip()) if found else ("", "")
        if word == "subsection":
            sections.append(rest)
        elif word == "end":
            sections.pop()
        yield block, word, rest, list(sections)


def without(file, keys, sections=()):
    """The text of a scene without some keys, each "Section/Key": those of an integrator that another one does not know,
    for example. What the scene includes stands in it, but for what the scene itself sets anew; names of other files remain
    as they are."""
    text = ""
    own = {"/".join([*inside, rest]) for _, word, rest, inside in parts_of(file, sections) if word == "set"}
    for block, word, rest, inside in parts_of(file, sections):
        if word == "include":
            text += without(os.path.join(os.path.dirname(file), rest), own.union(keys), inside)
        elif word != "set" or "/".join([*inside, rest]) not in keys:
            text += block
    return text


def named_files(scene, values):
    """Contents of all files that the scene or other values name, wherever such names may begin: digests."""
    texts = [all_text(scene), *values]
    folders = {os.path.dirname(os.path.abspath(scene))}
    folders |= {os.path.join(os.path.dirname(os.path.abspath(scene)), name.strip())
                for text in texts for name in re.findall(r"Folder of files\s*=([^#\n]*)", text)}
    words = sorted({word.strip() for text in texts for part in re.split(r"[=\n#]", text) for word in (part, *part.split())
                    if word.strip()})
    found = []
    for path in (os.path.join(folder, word) for folder in sorted(folders) for word in words):
        if len(path) < 4000 and os.path.isfile(path):
            with open(path, "rb") as file:
                found.append(hashlib.sha256(file.read()).hexdigest())
    return found


def all_text(file, seen=()):
    """The text of a scene with the files that it includes and names."""
    try:
        with open(file, errors="replace") as stream:
            text = stream.read()
    except OSError:
        return ""
    folder = os.path.dirname(file)
    for name in re.findall(r"^\s*include\s+([^#\n]*[^#\s])|=\s*(\S+\.(?:msh|stl|csv))\s*$", text, re.M):
        other = os.path.join(folder, name[0] or name[1])
        if other not in seen:
            text += all_text(other, (*seen, file))
    return text
