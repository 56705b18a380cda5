#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The checks of the sources find what they are there to find: each is run on a small tree with one
fault, and on the same tree without it."""
import pathlib
import tempfile
import unittest

import check_include_direction
import check_style

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
        return list(check_style.problems(self.root))

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

    def test_room_sees_one_above_it(self):
        self.write("source/solid/material/rubber.cc", LICENCE + "#include <undine/solid/mesh/beam.h>\n")
        self.expect(self.includes(), "source/solid/material/rubber.cc:2:", "'solid/mesh'")

    def test_room_sees_the_face_of_its_module(self):
        self.write("source/fluid/grid/lattice.cc", LICENCE + "#include <undine/fluid/fluid_step.h>\n")
        self.expect(self.includes(), "source/fluid/grid/lattice.cc:2:", "'fluid'")

    def test_contact_sees_cutting(self):
        self.write("source/contact/barrier.cc", LICENCE + "#include <undine/cutting/cut_block.h>\n")
        self.expect(self.includes(), "source/contact/barrier.cc:2:", "'contact'", "'cutting'")

    def test_folders_of_parts_belong_to_their_room(self):
        self.write("source/solid/material/materials/rubber.cc",
                   LICENCE + "#include <undine/solid/mesh/beam.h>\n")
        self.expect(self.includes(), "'solid/material'")

    def test_unknown_room(self):
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
        self.assertEqual(self.style(), [])

    def test_licence(self):
        self.write("source/solid/mesh/beam.cc", "int a;\n")
        self.expect(self.style(), "source/solid/mesh/beam.cc:1:", "LGPL")

    def test_guard(self):
        self.write("include/undine/solid/mesh/beam.h", LICENCE + "#ifndef beam_h\n#define beam_h\n#endif\n")
        self.expect(self.style(), "undine_solid_mesh_beam_h")

    def test_long_file(self):
        self.write("source/solid/mesh/beam.cc", LICENCE + "int a;\n" * 400)
        self.expect(self.style(), "401 lines")

    def test_long_function(self):
        body = "".join(f"    if (a)\n      {{ a = {i}; }}\n" for i in range(30))
        text = ("namespace undine\n{\n  class Beam\n  {\n  public:\n    void\n    f(int a)\n    {\n" +
                body + "    }\n    int g() { return 1; } // {\n  };\n}\n")
        self.write("source/solid/mesh/beam.cc", LICENCE + text)
        self.expect(self.style(), "source/solid/mesh/beam.cc:7:", "64 lines")

    def test_unfinished(self):
        self.write("source/solid/mesh/beam.cc", LICENCE + "// TODO\n")
        self.expect(self.style(), "source/solid/mesh/beam.cc:2:")

    def test_switched_off(self):
        self.write("source/solid/mesh/beam.cc", LICENCE + "#if 0\n#endif\n")
        self.expect(self.style(), "switched-off")

    def test_dimension(self):
        self.write("source/solid/mesh/beam.cc", LICENCE + "if (dim == 2)\n;\n")
        self.expect(self.style(), "dim")


if __name__ == "__main__":
    unittest.main()
