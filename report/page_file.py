# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a page is kept: nothing of others is replaced, and the record of the folder's run names it as one of its files."""
import os

from report.template import GENERATOR

NAME = "report.html"
MARK = f'name="generator" content="{GENERATOR}"'


def assert_own(path):
    """Throws FileExistsError if the file is there and no page of this program."""
    if os.path.exists(path):
        with open(path, encoding="utf-8", errors="replace") as file:
            if MARK not in file.read(2000):
                raise FileExistsError(0, "it is there and no page of Undine; move it away, or choose another with --out")


def record(path):
    """A run that replaces this one in its folder may then replace the page, too."""
    listed = os.path.join(os.path.dirname(path), "record.txt")
    line = f"file {NAME}\n"
    if os.path.basename(path) == NAME and os.path.exists(listed):
        with open(listed, encoding="utf-8") as file:
            if line in file.readlines():
                return
        with open(listed, "a", encoding="utf-8") as file:
            file.write(line)


def write(path, text):
    """Whole or not at all. Throws OSError."""
    assert_own(path)
    record(path)
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)
