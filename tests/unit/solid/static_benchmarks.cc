// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_scene.h"

#include <catch2/catch.hpp>

using namespace undine_tests;

namespace
{
  /// The flag of Turek and Hron: its left end follows the cylinder.
  std::string
  flag(const double E, const unsigned int refinements)
  {
    return one_body(
      "set Shape = box\nset Lower corner = 0, 0.19\nset Upper corner = 0.6, 0.21\n"
      "set Cells = 18, 1\nset Map = 0.2+sqrt(0.0025-(y-0.2)^2) + "
      "x/0.6*(0.4-sqrt(0.0025-(y-0.2)^2)); y\n"
      "set Density = 1000\nset Material = Saint Venant-Kirchhoff\nset Young's modulus = " +
        std::to_string(E) +
        "\nset Poisson's ratio = 0.4\nset Refinements = " + std::to_string(refinements),
      boundary("root", "set Sides = left"),
      "set Time integrator = static");
  }
} // namespace


TEST_CASE("the flag of Turek and Hron bends under gravity as published", "[solid]")
{
  SolidEnvironment<2> gravity;
  gravity.gravity[1] = -2;
  struct Case
  {
    double E, ux, uy;
  };
  for (const auto &test :
       {Case{1.4e6, -0.00718767, -0.0661023}, Case{5.6e6, -0.000469, -0.0169739}})
    {
      Solid<2>   solid(flag(test.E, 1), gravity);
      const auto report = solid.advance(1);
      const auto tip    = solid.displacement({0.6, 0.2});
      for (double r : report.newton.residuals)
        std::printf("%g ", r);
      std::printf("\n %.9g %.9g %.3f%% %.3f%%\n",
                  tip[0],
                  tip[1],
                  100 * (tip[0] / test.ux - 1),
                  100 * (tip[1] / test.uy - 1));
      CHECK(tip[0] == Approx(test.ux).epsilon(0.005));
      CHECK(tip[1] == Approx(test.uy).epsilon(0.005));
      CHECK(solid.column("reaction body/root y") ==
            Approx(2 * solid.column("volume body") * 0 +
                   2 * 1000 * measure_bodies(solid.model, solid.model.vector())[0].volume));
    }
}
