// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_scene.h"

#include <undine/solid/assembly/prescribed_motion.h>

#include <catch2/catch.hpp>

using namespace undine_tests;

namespace
{
  /// A bar of which one side is held and the other one moved.
  std::string
  moved_bar(const std::string &motion, const std::string &integrator)
  {
    return one_body("set Upper corner = 1, .2\nset Cells = 4, 1\nset Density = 1000\n"
                    "set Young's modulus = 1e6\nset Poisson's ratio = .3",
                    boundary("wall", "set Sides = left") +
                      boundary("press",
                               "set Sides = right\nset Kind = prescribed motion\n"
                               "set Displacement = " +
                                 motion + "; 0"),
                    "",
                    "set Integrator = " + integrator);
  }
} // namespace


TEST_CASE("The velocity of a support at the end of a step is that within it", "[solid][mpi]")
{
  for (const auto &[motion, exact] :
       {std::pair("0.1*min(t,1)", .1), std::pair("0.1-0.1*(1-t)^1.5", 0.)})
    {
      INFO(motion);
      Solid<2> solid(moved_bar(motion, "newmark"));
      auto     velocity = solid.model.vector();
      prescribe_velocity(velocity, solid.model, 1, .1);
      CHECK(velocity.max() == Approx(exact).margin(1e-3));
    }
  Solid<2> solid(moved_bar("0.1-0.1*(1-t)^0.5", "newmark"));
  auto     velocity = solid.model.vector();
  CHECK_THROWS_WITH(prescribe_velocity(velocity, solid.model, 1.1, .1),
                    Catch::Contains("'press': the prescribed velocity"));
}
