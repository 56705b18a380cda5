#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The cases of a module's Catch2 program as tests of ctest.

usage: unit_cases.py write CALL [--by-file NAME]... FILE.cc...
       unit_cases.py check PROGRAM CTEST FOLDER PREFIX

The first reads the sources, since to ask the program would need its build, and prints CMake code: calls of

    CALL_serial(NAME FILTER N_CASES)      a case, or all cases of a file that is given --by-file
    CALL_parallel(N_CASES)                all cases that are tagged [mpi], if there are any

The second compares what the program says that it contains with what ctest, in the folder of a build, runs of it in
tests whose names begin with PREFIX: every case alone, and every case that is tagged [mpi] on several ranks.
"""
import argparse
import dataclasses
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

KNOWN = {"TEST_CASE": False, "TEMPLATE_TEST_CASE": True, "TEMPLATE_TEST_CASE_SIG": True}
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|(?P<raw>R"\([^)]*\)")|(?P<string>"(?:\\.|[^"\\\n])*")'
                   r"|'(?:\\.|[^'\\\n])'|(?P<word>[A-Za-z_]\w*)|(?P<sign>[^\s\w])|\d[\w.']*|\s+", re.S)
SIMPLE_ESCAPES = {'\\"': '"', "\\\\": "\\", "\\'": "'", "\\?": "?"}
FILENAMES_AS_TAGS = "-#"


class Unreadable(Exception):
    """FILE:LINE: what cannot become a test."""


@dataclasses.dataclass(frozen=True)
class Case:
    place: str  # FILE:LINE
    name: str
    tags: str
    several: bool  # a template: Catch2 appends ' - ' and the argument to the name of each instance

    def filter(self):
        """For Catch2: commas, brackets and backslashes mean something in a name, more signs before it."""
        escaped = re.sub(r"(^\W|[\\,\[])", r"\\\1", self.name)
        return escaped + (" - *" if self.several else "")

    def is_parallel(self):
        return "[mpi]" in self.tags.lower()


def value(literal, place):
    """Of a string literal with its quotes."""
    def character(match):
        if match[0] not in SIMPLE_ESCAPES:
            raise Unreadable(f"{place}: '{match[0]}' is not understood in the name of a case")
        return SIMPLE_ESCAPES[match[0]]
    return re.sub(r"\\.", character, literal[1:-1], flags=re.S)


def tokens(text):
    """Triples (kind, text, line) without comments and blanks; kind None for numbers and characters."""
    for match in TOKEN.finditer(text):
        if not match[0].isspace() and not match[0].startswith(("//", "/*")):
            yield match.lastgroup, match[0], text.count("\n", 0, match.start()) + 1


def literals(found, place):
    """The string that adjacent literals make, and the sign after them."""
    result = []
    for kind, text, _ in found:
        if kind != "string":
            if kind == "sign" and result:
                return "".join(result), text
            break
        result.append(value(text, place))
    raise Unreadable(f"{place}: the name and the tags of a case must be plain strings")


def cases(file):
    """The cases of a source file."""
    found = tokens(file.read_text())
    for kind, text, line in found:
        place = f"{file}:{line}"
        if kind != "word" or not re.search(r"TEST_CASE|^SCENARIO|^CATCH_", text) or text.startswith("CATCH_CONFIG"):
            continue
        if text not in KNOWN:
            raise Unreadable(f"{place}: '{text}' is not known to {pathlib.Path(__file__).name}")
        next(found)  # the bracket
        name, sign = literals(found, place)
        tags = literals(found, place)[0] if sign == "," else ""
        case = Case(place, name, tags, KNOWN[text])
        check(case)
        yield case


def check(case):
    """Names that a filter of Catch2 or CMake could not give again."""
    if not re.match(r'\w|[^\w\s*][^\s~"\[,\\]', case.name) or case.name.startswith("exclude:"):
        raise Unreadable(f"{case.place}: a case needs a name that begins with a letter or a digit")
    if case.name != case.name.strip() or case.name.endswith("*") or "$<" in case.name or "]=" in case.name:
        raise Unreadable(f"{case.place}: the name of a case must not end with a blank or '*', nor contain '$<' or ']='")
    if re.search(r"\[(\.|!hide|!mayfail|!shouldfail)", case.tags):
        raise Unreadable(f"{case.place}: a case that is hidden or may fail tests nothing; measurements belong "
                         "into benchmarks/")


def cases_by_file(files):
    """{file: its cases}; their names must differ in more than capitals, which filters of Catch2 do not see."""
    result = {file: list(cases(file)) for file in files}
    known = {}
    for case in (case for of_file in result.values() for case in of_file):
        key = case.name.lower()
        for other in known.values():
            if key == other.name.lower() or any(
                    one.several and two.name.lower().startswith(one.name.lower() + " - ")
                    for one, two in ((case, other), (other, case))):
                raise Unreadable(f"{case.place}: the name cannot be told from that of the case at {other.place}")
        known[key] = case
    return result


def write(call, files, by_file):
    """Lines of CMake code."""
    unknown = set(by_file) - {file.stem for file in files}
    if unknown:
        raise Unreadable(f"there is no file {' or '.join(sorted(unknown))}")
    by_file_of = cases_by_file(files)
    for file, found in by_file_of.items():
        if file.stem in by_file and found:
            yield f"{call}_serial([=[{file.stem}]=] [=[[#{file.stem}]]=] {len(found)})"
        else:
            for case in found:
                yield f"{call}_serial([=[{case.name}]=] [=[{case.filter()}]=] 1)"
    parallel = sum(case.is_parallel() for found in by_file_of.values() for case in found)
    if parallel:
        yield f"{call}_parallel({parallel})"


def listed(program, of_filter):
    """The names that the program says a filter gives."""
    result = subprocess.run([program, of_filter, FILENAMES_AS_TAGS, "--list-test-names-only"],
                            capture_output=True, text=True)
    if result.stderr:  # the exit code is the number of names
        raise Unreadable(f"{program} '{of_filter}': {result.stderr}")
    return set(result.stdout.splitlines())


def filters_of_ctest(program, ctest, folder, prefix):
    """{number of ranks: filters of all tests that call the program}; 1 without mpirun."""
    with tempfile.TemporaryDirectory() as elsewhere:  # ctest replaces the logs where it is called
        shutil.copy(pathlib.Path(folder, "CTestTestfile.cmake"), elsewhere)
        told = subprocess.run([ctest, "--show-only=json-v1"], cwd=elsewhere, capture_output=True, text=True,
                              check=True).stdout
    result = {}
    for test in json.loads(told)["tests"]:
        before, found, after = partition(test.get("command", []), program)
        if test["name"].startswith(prefix) and found and (not before or before[-2:-1] == ["-np"]):
            result.setdefault(int(before[-1]) if before else 1, []).append(after[0])
    return result


def partition(command, word):
    """What stands before the word, whether it is there, and what stands after it."""
    at = command.index(word) if word in command else len(command)
    return command[:at], at < len(command), command[at + 1:]


def differences(program, ctest, folder, prefix):
    """What the program contains and ctest does not run, a line each."""
    filters = filters_of_ctest(program, ctest, folder, prefix)
    every = listed(program, "*")
    if not every:
        yield f"{program} contains no cases"
    parallel = listed(program, "[mpi]")
    for ranks in sorted({1} | set(filters) | ({2, 3} if parallel else set())):
        wanted = every if ranks == 1 else parallel
        run = listed(program, ",".join(filters[ranks])) if ranks in filters else set()
        for name in sorted(wanted - run):
            yield f"no test runs on {ranks} rank(s): {name}"
        for name in sorted(run - wanted):
            yield f"a test on {ranks} ranks runs a case that is not tagged [mpi]: {name}"
        for single in filters.get(ranks, []):
            if not run:
                yield f"a test on {ranks} rank(s) runs nothing: {single}"
    print(f"{len(every)} cases, {len(parallel)} of them on several ranks too, in "
          f"{sum(map(len, filters.values()))} tests")


def main():
    if sys.argv[1] == "check":
        found = list(differences(*sys.argv[2:]))
        sys.exit("\n".join(found) if found else 0)
    parser = argparse.ArgumentParser()
    parser.add_argument("call")
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    parser.add_argument("--by-file", action="append", default=[])
    given = parser.parse_args(sys.argv[2:])
    try:
        print("\n".join(write(given.call, sorted(given.files), given.by_file)))
    except Unreadable as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main()
