# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether the files of a run are whole: statistics, JSON and XML."""
import json
import math
import re
import xml.parsers.expat

XML = (".pvd", ".vtu", ".pvtu", ".xdmf")


def faults(folder):
    """Pairs (verdict, detail) for a folder of results; the folder may be of a run that failed."""
    found = []
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.is_dir():
            continue
        if name.endswith(XML):
            found += [("broken file", f"{kind_of_name(name)}: {reason}") for reason in xml_faults(path)]
        elif name.endswith(".json"):
            found += [("broken file", f"{name}: {reason}") for reason in json_faults(path)]
        elif name == "statistics":
            found += statistics_faults(path)
        elif name.endswith(".part"):
            found.append(("broken file", f"{name} is left over"))
    return found


def kind_of_name(name):
    return re.sub(r"\d+", "0", name)


def xml_faults(path):
    """The whole of it, but for appended binary data."""
    data = path.read_bytes()
    end = data.find(b"<AppendedData")
    parser = xml.parsers.expat.ParserCreate()
    try:
        parser.Parse(data if end < 0 else data[:end], end < 0)
    except xml.parsers.expat.ExpatError as error:
        return [f"no XML: {xml.parsers.expat.ErrorString(error.code)}"]
    return []


def once(pairs):
    names = [name for name, _ in pairs]
    double = {name for name in names if names.count(name) > 1}
    if double:
        raise ValueError(f"the same name twice: {sorted(double)}")
    return dict(pairs)


def read_json(path):
    """Raises ValueError."""
    return json.loads(path.read_bytes().decode("utf-8"), object_pairs_hook=once)


def json_faults(path):
    try:
        read_json(path)
    except ValueError as error:
        return [f"no JSON: {re.sub(r'[0-9]+', '0', str(error))}"]
    return []


def statistics_faults(path):
    """Rows as long as the header, finite, of one step after the other, with time going on."""
    names, previous = [], None
    for line in path.read_text("utf-8", "surrogateescape").split("\n"):
        header = re.match(r"# (\d+): (.*) \[(.*)\]$", line)
        if header:
            names.append(header[2])
            if int(header[1]) != len(names):
                return [("broken file", "statistics: columns are not numbered one after the other")]
        elif line:
            try:
                row = [float(word) for word in line.split()]
            except ValueError:
                return [("broken file", "statistics: a line that is neither header nor numbers")]
            for name, value in zip(names, row):
                if not math.isfinite(value):
                    return [("not finite", f"statistics: {name} is {value}")]
            if len(row) != len(names):
                return [("broken file", "statistics: a row of another length than the header")]
            if previous and (row[0] != previous[0] + 1 or row[1] < previous[1]):
                return [("broken file", "statistics: steps or times are not in order")]
            previous = row
    return []


def same_run(folder, other):
    """What differs between two folders of the same run, but for what nobody assigned and where files are."""
    found = []
    if assigned(folder) != assigned(other):
        found.append("parameters.prm differs")
    if content(folder, "statistics") != content(other, "statistics"):
        found.append("statistics differs")
    return found


def content(folder, name):
    path = folder / name
    return path.read_bytes() if path.is_file() else b""


def assigned(folder):
    return [line.strip() for line in content(folder, "parameters.prm").split(b"\n") if line.strip() and
            not line.strip().startswith((b"# default:", b"set Folder of files", b"set Maximum steps"))]
