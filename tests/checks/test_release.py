#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""contrib/release gathers changes and sets the version in one place; what cites the version agrees with it."""
import importlib.machinery
import importlib.util
import pathlib
import re
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LOADER = importlib.machinery.SourceFileLoader("release", str(ROOT / "contrib" / "release"))
release = importlib.util.module_from_spec(importlib.util.spec_from_loader("release", LOADER))
LOADER.exec_module(release)


class Release(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "CITATION.cff").write_text("version: 0.0.1\ndate-released: 2020-01-01\n")

    def make(self, number, day, **changes):
        (self.root / "doc" / "changes").mkdir(parents=True, exist_ok=True)
        for name, text in changes.items():
            (self.root / "doc" / "changes" / f"{name}.md").write_text(text)
        return release.make(self.root, number, day)

    def changelog(self):
        return (self.root / "CHANGELOG.md").read_text().replace(release.TITLE, "")

    def test_changes_are_gathered_once(self):
        self.assertEqual(self.make("0.1.0", "2026-01-01", a="New: a\nand [b](../b.md).\n\nMore.\n", b="Fixed: c\n"), 2)
        self.assertEqual(self.changelog(),
                         "\n## 0.1.0 (2026-01-01)\n\n- Fixed: c\n- New: a\n  and [b](doc/b.md).\n\n  More.\n")
        self.assertEqual(list((self.root / "doc" / "changes").iterdir()), [])

    def test_same_version_again(self):
        self.make("0.1.0", "2026-01-01", a="One.")
        self.make("0.1.0", "2026-01-02", b="Two.")
        self.assertEqual(self.changelog(), "\n## 0.1.0 (2026-01-02)\n\n- Two.\n- One.\n")

    def test_next_version_comes_first(self):
        self.make("0.1.0", "2026-01-01", a="One.")
        self.make("0.2.0", "2026-02-01", b="Two.")
        self.assertEqual(self.changelog(), "\n## 0.2.0 (2026-02-01)\n\n- Two.\n\n## 0.1.0 (2026-01-01)\n\n- One.\n")
        self.assertEqual((self.root / "VERSION").read_text(), "0.2.0\n")
        self.assertEqual((self.root / "CITATION.cff").read_text(), "version: 0.2.0\ndate-released: 2026-02-01\n")

    def test_versions_of_the_sources_agree(self):
        version = (ROOT / "VERSION").read_text().strip()
        release.version(version)
        cited = re.search(r"^version: (.*)$", (ROOT / "CITATION.cff").read_text(), re.M)[1]
        changed = re.search(r"^## (\S+) ", (ROOT / "CHANGELOG.md").read_text(), re.M)[1]
        self.assertEqual((cited, changed), (version, version))
        self.assertNotRegex((ROOT / "CMakeLists.txt").read_text(), r"VERSION \d+\.\d+\.\d+ LANGUAGES")


if __name__ == "__main__":
    unittest.main()
