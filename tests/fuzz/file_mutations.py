# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mutations of files as such: bytes, includes and meshes. Each takes a random generator and the case."""
import re

import odd_values

SECRET = "pfauenauge"  # stands in files that are no scenes: no message may quote it
SECRET_LINES = (
    f"{SECRET}", f"user: {SECRET}", f"set {SECRET}", f"set Title {SECRET}", f"password {SECRET} # {SECRET}",
    f"include\t{SECRET}", f"subsection {SECRET}", f"set {SECRET} = 1", f"set Dimension = {SECRET}", f"subsection a/{SECRET}",
    f"set a/{SECRET} = 1")
MARK = b"\xef\xbb\xbf"


def text_file(rng, case):
    """The scene, or sometimes what it includes."""
    names = sorted(name for name in case.files if name.endswith((".prm", ".inc")))
    return case.scene if rng.random() < 0.7 else rng.choice(names)


def changed_bytes(rng, data):
    """Some bytes flipped, inserted, taken out or repeated."""
    if not data:
        return b"\x00"
    at = rng.randrange(len(data))
    length = min(len(data) - at, rng.choice((1, 1, 2, 10, 100)))
    return rng.choice((
        data[:at] + bytes([data[at] ^ (1 << rng.randrange(8))]) + data[at + 1:],
        data[:at] + bytes(rng.randrange(256) for _ in range(length)) + data[at:],
        data[:at] + data[at + length:], data[:at] + data[at:at + length] * rng.choice((2, 50)) + data[at + length:],
        data[:at], data[:at] + b"\x00" + data[at:], data[:at] + b"\n" + data[at:]))


def flipped_bytes(rng, case):
    name = text_file(rng, case)
    for _ in range(rng.choice((1, 1, 3, 20))):
        case.files[name] = changed_bytes(rng, case.files[name])


def encoding(rng, case):
    name = text_file(rng, case)
    data = case.files[name]
    text = case.text(name)
    case.files[name] = rng.choice((
        MARK + data, MARK + MARK + data, data + MARK, data.replace(b"\n", b"\r\n"), data.replace(b"\n", b"\r"),
        text.encode("utf-16", "replace"), text.encode("utf-32", "replace"), data + b"\x00", data + b"\x1a", b"",
        b"\n", b"\x00" * 1000, data.rstrip(b"\n"), data.replace(b" ", b"\xc2\xa0", 3), data.replace(b" ", b"\t"),
        data.replace(b"=", "＝".encode(), 1), bytes(rng.randrange(256) for _ in range(2000))))


def include(rng, case):
    """A line that includes something, put anywhere."""
    name = text_file(rng, case)
    included = rng.choice(INCLUDES)(rng, case, name)
    lines = case.text(name).split("\n")
    lines.insert(rng.randrange(len(lines) + 1), f"include {included}")
    case.set_text(name, "\n".join(lines))


def include_other(rng, case, name):
    return rng.choice(("missing.inc", name, ".", "..", "/", "/dev/null", "/dev/zero", "./" + name, "folder", "a" * 5000,
                       rng.choice(odd_values.NAMES), "/etc/no_such_file", "\"quoted.inc\"", "missing.inc # why"))


def include_each_other(rng, case, name):
    case.files["one.inc"], case.files["two.inc"] = b"include two.inc\n", b"include one.inc\n"
    return "one.inc"


def include_many(rng, case, name):
    """Files that include the next one twice, which would be read without end."""
    n_files = rng.choice((5, 40))
    for number in range(n_files):
        case.files[f"chain{number}.inc"] = f"include chain{number + 1}.inc\n".encode() * 2
    case.files[f"chain{n_files}.inc"] = b"# nothing\n"
    return "chain0.inc"


def include_deep(rng, case, name):
    for number in range(200):
        case.files[f"deep{number}.inc"] = f"include deep{number + 1}.inc\n".encode()
    case.files["deep200.inc"] = b"# nothing\n"
    return "deep0.inc"


def include_foreign(rng, case, name):
    """A file that is no scene and whose content is nobody's business."""
    foreign = rng.choice(("notes.txt", "key", ".netrc", "table.csv", "sub/notes", "notes.prm.bak"))
    before = rng.choice((b"", b"# a comment\n", b"\n\n"))
    case.files[foreign] = before + rng.choice(SECRET_LINES).encode() + b"\n"
    return foreign


def include_binary(rng, case, name):
    case.files["program.bin"] = b"\x7fELF\x02" + SECRET.encode() + bytes(rng.randrange(256) for _ in range(3000))
    return "program.bin"


def include_mesh(rng, case, name):
    meshes = sorted(other for other in case.files if other.endswith((".msh", ".stl")))
    return rng.choice(meshes) if meshes else include_foreign(rng, case, name)


def include_odd_name(rng, case, name):
    odd = rng.choice(("a b.inc", "a#b.inc", "é.inc", "a\\b.inc", "a\"b.inc", "..inc", "a=b.inc"))
    case.files[odd] = b"# nothing\n"
    case.folders.append("folder")
    return rng.choice((odd, odd.replace("\\", "\\\\").replace("#", "\\#")))


INCLUDES = (include_other, include_other, include_each_other, include_many, include_deep, include_foreign,
            include_foreign, include_foreign, include_binary, include_mesh, include_odd_name)


def foreign_file_named(rng, case):
    """A mesh or surface that is a file of another kind."""
    name = text_file(rng, case)
    text = case.text(name)
    case.files["notes.txt"] = rng.choice(SECRET_LINES).encode() + b"\n"
    case.set_text(name, re.sub(r"(set (?:File|Surface)\s*=\s*)\S+",
                               lambda match: match[1] + rng.choice(("notes.txt", "folder", ".", case.scene)), text))


def mesh(rng, case):
    """Its numbers, its lines or its bytes."""
    meshes = sorted(name for name in case.files if name.endswith((".msh", ".stl")))
    if not meshes:
        return flipped_bytes(rng, case)
    name = rng.choice(meshes)
    lines = case.text(name).split("\n")
    for _ in range(rng.choice((1, 1, 2, 5))):
        at = rng.randrange(len(lines))
        kind = rng.randrange(7)
        if kind <= 2:
            words = lines[at].split(" ")
            words[rng.randrange(len(words))] = rng.choice(odd_values.NUMBERS + ["99999999999", "-7", "0", "1", "a"])
            lines[at] = " ".join(words)
        elif kind == 3 and len(lines) > 1:
            del lines[at]
        elif kind == 4:
            lines.insert(rng.randrange(len(lines)), lines[at])
        elif kind == 5:
            del lines[at + 1:]
        else:
            lines = case.text(name).split("\n")
    case.set_text(name, "\n".join(lines))
    if rng.random() < 0.2:
        case.files[name] = changed_bytes(rng, case.files[name])
    return None


def scene_is_something_else(rng, case):
    """The file named on the command line is no scene, or no file."""
    case.files["notes.txt"] = "\n".join(rng.sample(SECRET_LINES, 3)).encode()
    case.files["odd name\".prm"] = case.files[case.scene]
    case.files["odd\\na#me.prm"] = case.files[case.scene]
    case.folders.append("folder.prm")
    case.scene = rng.choice(("notes.txt", "missing.prm", "folder.prm", ".", "odd name\".prm", "odd\\na#me.prm", "é.prm",
                             "a" * 5000, "/dev/null", "./" + case.scene))


MUTATIONS = {  # name: (function, weight)
    "bytes": (flipped_bytes, 5), "encoding": (encoding, 4), "include": (include, 7),
    "foreign file named": (foreign_file_named, 2), "mesh": (mesh, 6), "scene is something else": (scene_is_something_else, 1)}
