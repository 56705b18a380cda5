#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Documents become Doxygen's without losing formulas, headings and links.

With the argument --make the whole manual is made and looked at; leaves with 77 (skipped) where Doxygen is missing.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MANUAL = ROOT / "contrib" / "manual"
sys.path.insert(0, str(MANUAL))
import check_documents  # noqa: E402
import filter as manual_filter  # noqa: E402


class Filter(unittest.TestCase):
    def converted(self, line):
        file = ROOT / "doc" / "equations.md"
        pages = {page.resolve() for page in check_documents.documents(ROOT)}
        return manual_filter.converted(file, line, check_documents.without_code(line), pages)

    def test_formulas(self):
        self.assertEqual(self.converted("with $a_b$, $c$"), r"with \f$a_b\f$, \f$c\f$")
        self.assertEqual(self.converted("not `$a$`"), "not `$a$`")

    def test_links(self):
        self.assertEqual(self.converted("[x](solver.md)"), "[x](@ref doc_solver)")
        self.assertEqual(self.converted("[x](#the-solid) $a$"), r"[x](@ref doc_equations_the_solid) \f$a\f$")
        self.assertEqual(self.converted("[y](../README.md)"), "[y](@ref index)")
        self.assertEqual(self.converted("[y](../prm/cavity.prm)"), "y")
        self.assertEqual(self.converted("[y](https://www.dealii.org)"), "[y](https://www.dealii.org)")
        self.assertEqual(self.converted("![y](pictures/a.png)"), "![y](pictures/a.png)")

    def test_every_link_has_its_label(self):
        """All labels that links lead to are those of headings."""
        pages = {page.resolve() for page in check_documents.documents(ROOT)}
        labels = {name for page in pages for name in manual_filter.names_of_headings(page)}
        self.assertEqual(sum(len(manual_filter.names_of_headings(page)) for page in pages), len(labels))
        for page in pages:
            for match in check_documents.LINK.finditer(check_documents.without_code(page.read_text())):
                found = manual_filter.target(page, match[1], pages)
                self.assertTrue(found is None or found in labels, f"{page}: {match[1]}")


def check_manual():
    """The manual has a page for every document, no reference that leads nowhere, and equations that MathJax draws."""
    if not shutil.which("doxygen") or not shutil.which("dot"):
        print("skipped: the Debian packages in contrib/manual/packages are not installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([MANUAL / "make", folder], check=True)
        warnings = pathlib.Path(folder, "warnings").read_text()
        bad = re.findall(r"^.*\.md:\d+: warning:.*$|^.*unable to resolve.*$", warnings, re.M)
        html = pathlib.Path(folder, "html")
        for page in check_documents.documents(ROOT):
            name = f"{manual_filter.label(page)}.html"
            bad += [] if (html / name).exists() else [f"there is no page {name}"]
        text = (html / "doc_equations.html").read_text()
        shown = len(re.findall(r"\\\[", text))
        wanted = len(re.findall(r"^\$\$$", (ROOT / "doc" / "equations.md").read_text(), re.M)) / 2
        bad += [] if shown == wanted else [f"doc_equations.html shows {shown} of {wanted} formulas"]
        bad += [] if (html / "mathjax" / "MathJax.js").exists() else ["MathJax is missing"]
        bad += [f"{page.name} loads from the network" for page in html.glob("*.html")
                if re.search(r"<(script|link)[^>]*(src|href)=\"https?:", page.read_text())]
    if bad:
        sys.exit("\n".join(bad))


if __name__ == "__main__":
    if "--make" in sys.argv:
        check_manual()
    else:
        unittest.main()
