// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/obstacle_run.h>

using namespace undine_tests;

namespace
{
  /// A gap of width 0.05 + 1.1 t between floor and a rising ceiling, closed at the left, open at
  /// the right: Q = 1.1 m^2/s is drawn in.
  double
  largest_energy_ratio(const std::string &method, const double dt)
  {
    ObstacleRun<2> run(
      section("Domain", "set Upper corner = 1, 1\nset Cells = 16, 16") +
        section("Fluid",
                "set Density = 1\n" + section("Boundaries", boundary("out", "right", "outflow"))),
      obstacle("ceiling",
               "box",
               "set Lower corner = -.5, .05\nset Upper corner = 1.5, 2\n"
               "set Displacement = 0; 1.1*t"),
      convection(method),
      dt);
    double largest = 0, narrower = .05;
    while (run.state.clock.time < .5)
      {
        const double width = .05 + 1.1 * run.state.clock.time;
        run.step();
        CHECK(run.column("Flux through out") == Approx(-1.1));
        // All of it as fast as what entered in the step before, in the mean.
        const double bound = std::pow(1.1 / narrower, 2) / 2 * width;
        narrower           = width;
        largest            = std::max(largest, run.column("Fluid kinetic energy") / bound);
      }
    return largest;
  }
} // namespace


TEST_CASE("a rising ceiling draws fluid in through an outflow, at any step", "[coupled]")
{
  for (const std::string method : {"semi-Lagrangian", "MacCormack", "cubic"})
    for (const double dt : {.01, .05, .1})
      {
        INFO(method << ", dt = " << dt);
        CHECK(largest_energy_ratio(method, dt) < 1);
      }
}
