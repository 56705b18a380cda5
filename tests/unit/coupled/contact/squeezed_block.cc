// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// Two obstacles come together by .06 m each within a second, with a block in water between them.
  CoupledRun<2>
  squeezed_block(const double dt)
  {
    const std::string way = "0.06*min(1,t)^2*(3-2*min(1,t)); 0";
    return CoupledRun<2>(
      steps_of(dt) + section("Domain", "set Cells = 17, 18") +
      section("Fluid",
              "set Density = 1000\n" +
                section("Boundaries",
                        section("top", "set Sides = top\nset Kind = pressure\nset Pressure = 0"))) +
      section("Bodies",
              body("block",
                   "set Lower corner = .4, .35\nset Upper corner = .6, .65\nset Cells = 2, 3\n"
                   "set Density = 2000\nset Young's modulus = 1e5\nset Poisson's ratio = .3")) +
      section(
        "Obstacles",
        section("left",
                "set Lower corner = .1, .3\nset Upper corner = .38, .7\nset Displacement = " +
                  way) +
          section("right",
                  "set Lower corner = .62, .3\nset Upper corner = .9, .7\nset Displacement = -" +
                    way)) +
      section("Effects",
              section("contact", "set Activation distance = .01") +
                section("damping", "set Mass coefficient = 10\nset Stiffness coefficient = .001")) +
      section("Output", "set Energy account = true"));
  }
} // namespace


TEST_CASE("what obstacles put into a body that they squeeze is no energy from nowhere", "[contact]")
{
  for (const double dt : {1. / 60, 1. / 120})
    {
      INFO("steps of " << dt);
      auto run = squeezed_block(dt);
      while (run.state.clock.time < 1)
        {
          run.step();
          CHECK(run.report.cuts == 0);
        }
      const double energy = run.column("solid elastic energy") + run.column("contact energy");
      CHECK(energy > 500);
      CHECK(run.column("energy created") < .01 * energy);
    }
}
