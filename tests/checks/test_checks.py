#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The checks of the sources find what they are there to find: each is run on a small tree with one
fault, and on the same tree without it."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import check_include_direction  # noqa: E402
import check_style  # noqa: E402
import scene_tools  # noqa: E402
import unit_cases  # noqa: E402  in the folder above

LICENCE = "// SPDX-License-Identifier: LGPL-2.1-or-later\n"


class Tree(unittest.TestCase):
    """A repository of two good files in a temporary folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.write("include/undine/solid/mesh/beam.h",
                   LICENCE + "#ifndef undine_solid_mesh_beam_h\n#define undine_solid_mesh_beam_h\n"
                   "#include <undine/base/core/clock.h>\n#endif\n")
        self.write("source/solid/mesh/beam.cc", LICENCE + "#include <undine/solid/mesh/beam.h>\n")

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def includes(self):
        return list(check_include_direction.problems(self.root))

    def style(self):
        return check_style.problems(self.root)

    def hints(self):
        """What is said without a fault."""
        self.assertEqual(self.style(), [])
        return check_style.hints(self.root)

    def expect(self, found, *words):
        self.assertEqual(len(found), 1, found)
        for word in words:
            self.assertIn(word, found[0])


class IncludeDirection(Tree):
    def test_good_tree(self):
        self.assertEqual(self.includes(), [])

    def test_solid_sees_fluid(self):
        self.write("source/solid/mesh/beam.cc", LICENCE + "\n#include <undine/fluid/grid/lattice.h>\n")
        self.expect(self.includes(), "source/solid/mesh/beam.cc:3:", "'solid/mesh'", "'fluid/grid'")

    def test_upward(self):
        self.write("source/fluid/grid/lattice.cc", LICENCE + "#include <undine/effects/effect.h>\n")
        self.expect(self.includes(), "source/fluid/grid/lattice.cc:2:", "'effects'")

    def test_folder_sees_one_above_it(self):
        self.write("source/solid/material/rubber.cc", LICENCE + "#include <undine/solid/mesh/beam.h>\n")
        self.expect(self.includes(), "source/solid/material/rubber.cc:2:", "'solid/mesh'")

    def test_folder_sees_the_top_of_its_module(self):
        self.write("source/fluid/grid/lattice.cc", LICENCE + "#include <undine/fluid/fluid_stage.h>\n")
        self.expect(self.includes(), "source/fluid/grid/lattice.cc:2:", "'fluid'")

    def test_contact_sees_cutting(self):
        self.write("source/contact/barrier.cc", LICENCE + "#include <undine/cutting/cut_block.h>\n")
        self.expect(self.includes(), "source/contact/barrier.cc:2:", "'contact'", "'cutting'")

    def test_folders_of_parts_belong_to_theirs(self):
        self.write("source/solid/material/materials/rubber.cc",
                   LICENCE + "#include <undine/solid/mesh/beam.h>\n")
        self.expect(self.includes(), "'solid/material'")

    def test_unknown_folder(self):
        self.write("source/fluid/cellar/wine.cc", LICENCE)
        self.expect(self.includes(), "source/fluid/cellar/wine.cc:1:")

    def test_crowded_folder(self):
        for number in range(26):
            self.write(f"source/contact/part_{number}.cc", LICENCE)
        self.expect(self.includes(), "source/contact:1:", "26 files")

    def test_core_sees_deal_ii(self):
        self.write("source/base/core/clock.cc", LICENCE + "#include <deal.II/base/mpi.h>\n")
        self.expect(self.includes(), "source/base/core/clock.cc:2:", "deal.II")

    def test_core_sees_options(self):
        self.write("source/base/core/clock.cc",
                   LICENCE + "#include <undine/base/options/options.h>\n")
        self.expect(self.includes(), "'base/options'")

    def test_kernels_see_deal_ii(self):
        self.write("cuda/pressure.cu", LICENCE + "#include <deal.II/base/point.h>\n")
        self.expect(self.includes(), "cuda/pressure.cu:2:", "deal.II")

    def test_unknown_module(self):
        self.write("source/magic/wand.cc", LICENCE)
        self.expect(self.includes(), "source/magic/wand.cc:1:")

    def test_cycle(self):
        for name, other in (("a", "b"), ("b", "a")):
            self.write(f"include/undine/fluid/grid/{name}.h",
                       f"#include <undine/fluid/grid/{other}.h>\n")
        self.assertIn("cycle", self.includes()[0])


class Style(Tree):
    def test_good_tree(self):
        self.assertEqual(self.hints(), [])

    def test_licence(self):
        self.write("source/solid/mesh/beam.cc", "int a;\n")
        self.expect(self.style(), "source/solid/mesh/beam.cc:1:", "LGPL")

    def test_guard(self):
        self.write("include/undine/solid/mesh/beam.h", LICENCE + "#ifndef beam_h\n#define beam_h\n#endif\n")
        self.expect(self.style(), "undine_solid_mesh_beam_h")

    def test_long_file(self):
        self.write("source/solid/mesh/beam.cc", LICENCE + "int a;\n" * 400)
        self.expect(self.hints(), "source/solid/mesh/beam.cc:401:", "401 lines")

    def test_long_function(self):
        body = "".join(f"    if (a)\n      {{ a = {i}; }}\n" for i in range(30))
        text = ("namespace undine\n{\n  class Beam\n  {\n  public:\n    void\n    f(int a)\n    {\n" +
                body + "    }\n    int g() { return 1; } // {\n  };\n}\n")
        self.write("source/solid/mesh/beam.cc", LICENCE + text)
        self.expect(self.hints(), "source/solid/mesh/beam.cc:7:", "64 lines")

    def test_hints_do_not_fail(self):
        script = pathlib.Path(check_style.__file__)
        for text, code in ((LICENCE + "int a;\n" * 400, 0), (LICENCE + "int a;\n" * 400 + "// TODO\n", 1)):
            self.write("source/solid/mesh/beam.cc", text)
            result = subprocess.run([sys.executable, script, self.root], capture_output=True, text=True)
            self.assertEqual(result.returncode, code, result)
            self.assertIn("hint: source/solid/mesh/beam.cc:", result.stdout)

    def test_unfinished(self):
        self.write("source/solid/mesh/beam.cc", LICENCE + "// TODO\n")
        self.expect(self.style(), "source/solid/mesh/beam.cc:2:")

    def test_switched_off(self):
        self.write("source/solid/mesh/beam.cc", LICENCE + "#if 0\n#endif\n")
        self.expect(self.style(), "switched-off")

    def test_dimension(self):
        self.write("source/solid/mesh/beam.cc", LICENCE + "if (dim == 2)\n;\n")
        self.expect(self.style(), "dim")


    def test_shared_names(self):
        text = LICENCE + ("namespace undine\n{\n  namespace\n  {\n    template <class T>\n    double\n    sum(const T &terms)\n"
                          "    {\n      return total(terms);\n    }\n  } // namespace\n} // namespace undine\n")
        self.write("source/solid/mesh/beam.cc", text)
        self.write("source/fluid/grid/lattice.cc", text)  # of another module
        self.assertEqual(self.style(), [])
        self.write("source/solid/material/rubber.cc", text.replace("const T &terms", "const double *terms"))
        self.expect(self.style(), "source/solid/mesh/beam.cc", "'sum'", "source/solid/material/rubber.cc")


class Differences(unittest.TestCase):
    """Of files `statistics`."""
    HEAD = "# 1: Step [1]\n# 2: speed [m/s]\n"

    def differ(self, text, record):
        return scene_tools.differences(text, record, 1e-8, True)

    def test_same(self):
        self.assertEqual(self.differ(self.HEAD + "0 1\n1 2\n", self.HEAD + "0 1\n1 2.00000001\n"), [])

    def test_number(self):
        self.assertEqual(len(self.differ(self.HEAD + "0 1\n1 2\n", self.HEAD + "0 1\n1 2.1\n")), 1)

    def test_no_number(self):
        for word in ("nan", "inf"):
            self.assertTrue(self.differ(self.HEAD + f"0 {word}\n", self.HEAD + f"0 {word}\n"))
            self.assertTrue(self.differ(self.HEAD + "0 1\n", self.HEAD + f"0 {word}\n"))

    def test_rows(self):
        self.assertTrue(self.differ(self.HEAD + "0 1\n", self.HEAD + "0 1\n1 2\n"))
        self.assertTrue(self.differ(self.HEAD + "0\n", self.HEAD + "0 1\n"))
        self.assertTrue(self.differ(self.HEAD, self.HEAD))
        self.assertTrue(self.differ("0 1\n", "0 2\n"))

    def test_columns(self):
        self.assertTrue(self.differ(self.HEAD + "0 1\n", self.HEAD.replace("speed", "length") + "0 1\n"))


class UnitCases(Tree):
    """What unit_cases.py reads from sources."""

    def lines(self, text, *by_file):
        self.write("tests/unit/solid/beam.cc", LICENCE + text)
        return list(unit_cases.write("unit", [self.root / "tests/unit/solid/beam.cc"], by_file))

    def refused(self, text, word):
        with self.assertRaises(unit_cases.Unreadable) as raised:
            self.lines(text)
        self.assertIn("beam.cc:", str(raised.exception))
        self.assertIn(word, str(raised.exception))

    def test_name_over_several_literals(self):
        self.assertEqual(self.lines('TEST_CASE("a beam, "\n          "bent", // far\n  "[solid]")\n{}\n'),
                         [r"unit_serial([=[a beam, bent]=] [=[a beam\, bent]=] 1)"])

    def test_signs(self):
        self.assertEqual(self.lines(r'TEST_CASE("x \"y\" \\ [z];") {}'),
                         [r'unit_serial([=[x "y" \ [z];]=] [=[x "y" \\ \[z];]=] 1)'])

    def test_first_sign(self):
        self.assertEqual(self.lines('TEST_CASE("--set") {}'), [r"unit_serial([=[--set]=] [=[\--set]=] 1)"])

    def test_templates_are_one_test(self):
        self.assertEqual(self.lines('TEMPLATE_TEST_CASE_SIG("a", "", ((int dim), dim), 2, 3) {}\n'
                                    'TEMPLATE_TEST_CASE("b", "[x]", int, double) {}'),
                         ["unit_serial([=[a]=] [=[a - *]=] 1)", "unit_serial([=[b]=] [=[b - *]=] 1)"])

    def test_several_ranks(self):
        self.assertEqual(self.lines('TEST_CASE("a", "[solid][mpi]") {}\nTEST_CASE("b", "[solid]") {}', "beam"),
                         ["unit_serial([=[beam]=] [=[[#beam]]=] 2)",
                          "unit_parallel(1)"])

    def test_comments_and_strings(self):
        self.assertEqual(self.lines('// TEST_CASE("a")\n/* TEST_CASE("b") */\n'
                                    'const char *c = "TEST_CASE(\\"c\\")", d = \'"\';\n'), [])

    def test_what_cannot_be_a_test(self):
        self.refused('TEST_CASE("a", "[.][speed]") {}', "hidden")
        self.refused('TEST_CASE("a", "[!mayfail]") {}', "hidden")
        self.refused("TEST_CASE(name) {}", "plain string")
        self.refused('TEST_CASE(R"(a)") {}', "plain string")
        self.refused('TEST_CASE("a\\n") {}', "not understood")
        self.refused('TEST_CASE("") {}', "begins with")
        self.refused("TEST_CASE() {}", "plain string")
        self.refused('TEST_CASE("a", tags) {}', "plain string")
        self.refused('TEST_CASE("a*") {}', "must not end")
        self.refused('SCENARIO("a") {}', "SCENARIO")
        self.refused('TEST_CASE("a") {}\nTEST_CASE("A") {}', "cannot be told")
        self.refused('TEMPLATE_TEST_CASE("a", "", int) {}\nTEST_CASE("a - b") {}', "cannot be told")

    def test_unknown_file(self):
        with self.assertRaises(unit_cases.Unreadable):
            self.lines("", "bean")


if __name__ == "__main__":
    unittest.main()
