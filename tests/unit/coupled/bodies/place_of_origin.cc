// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// A sheet that stands in a stream with gravity; the pressure is zero at the top of the domain,
  /// which reaches from `origin` [m] to 1 m above.
  std::string
  sheet_in_stream(const double origin, const std::string &friction)
  {
    const auto at = [&](const double y) { return fmt::format("{:.17g}", origin + y); };
    return steps_of(1e-3) +
           section("Domain",
                   "set Lower corner = 0, " + at(0) + "\nset Upper corner = 2, " + at(1) +
                     "\nset Cells = 21, 11") +
           section(
             "Fluid",
             "set Density = 1000\n" +
               section("Boundaries",
                       boundary("in", "left", "inflow", "set Velocity = .3*min(1,200*t); 0") +
                         boundary("out", "right", "outflow", "set Pressure = 9810*" + at(1)))) +
           section("Bodies",
                   body("sheet",
                        "set Lower corner = .8, " + at(-.1) + "\nset Upper corner = .87, " +
                          at(.5) +
                          "\nset Cells = 1, 6\nset Density = 1200\nset Young's modulus = 1e6\n"
                          "set Poisson's ratio = .3",
                        clamp("root", at(0) + "-y"))) +
           section("Effects", section("gravity", "set Acceleration = 0, -9.81") + friction);
  }
} // namespace


TEST_CASE("Bodies under gravity do not know where the origin is", "[coupled]")
{
  const auto account = section("Output", "set Energy account = true");
  const auto swept   = account + section("Time", "set Integrator = theta") +
                     section("Coupling", "set Boundary flux = swept");
  const auto friction = section("viscosity", "set Dynamic viscosity = 1");
  for (const auto &[effects, integrator] :
       {std::pair<std::string, std::string>{"", account}, {friction, account}, {"", swept}})
    {
      INFO(effects << integrator);
      CoupledRun<2> near(sheet_in_stream(0, effects) + integrator),
        far(sheet_in_stream(1000, effects) + integrator);
      for (unsigned int n = 0; n < 3; ++n)
        {
          near.step();
          far.step();
          for (const std::string name : {"Fluid kinetic energy",
                                         "solid kinetic energy",
                                         "solid elastic energy",
                                         "energy exchanged"})
            {
              INFO(name);
              CHECK(far.column(name) == Approx(near.column(name)).epsilon(1e-6));
            }
        }
    }
}
