// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <algorithm>

using namespace undine_tests;

namespace
{
  std::string
  sheet(const std::string &name,
        const double       left,
        const std::string &outside,
        const int          direction,
        const double       density)
  {
    return body(
      name,
      fmt::format("set Lower corner = {}, -0.05\nset Upper corner = {}, 0.7\nset Cells = 1, 20\n"
                  "set Density = {}\nset Young's modulus = 1e6\nset Poisson's ratio = 0.3",
                  left,
                  left + .02,
                  density),
      clamp("foot", "-y") + section("push",
                                    fmt::format("set Kind = traction\nset Where = y-0.55\n"
                                                "set Traction = {}*60*min(1,5*t)*({}); 0",
                                                direction,
                                                outside)));
  }


  /// The largest kinetic energy of the water while two sheets in it are pushed together, until they
  /// touch and close a region between them [J].
  double
  largest_energy(const double density, const double dt)
  {
    INFO(density << " kg/m^2, " << dt << " s");
    CoupledRun<2> run(
      steps_of(dt) + section("Domain", "set Cells = 16, 16") +
      section("Fluid",
              "set Density = 1000\n" + section("Boundaries", boundary("top", "top", "outflow"))) +
      section("Bodies",
              sheet("left", .38, "x<0.39", 1, density) +
                sheet("right", .6, "x>0.61", -1, density)) +
      section("Effects", convection() + section("contact", "")));
    double largest = 0;
    bool   touched = false;
    while (run.state.clock.time < 1.4)
      {
        run.step();
        largest = std::max(largest, run.column("Fluid kinetic energy"));
        touched = touched || run.column("nodes in contact") > 0;
      }
    CHECK(touched);
    CHECK(run.column("least gap") > 0);
    return largest;
  }
} // namespace


TEST_CASE("sheets close a region of water with the same energy, however light they are",
          "[contact]")
{
  // Nearly all of it is the water's, so that the sheets' density hardly matters.
  const double expected = .39;
  for (const double density : {1000., 100., 10., 1.})
    CHECK(largest_energy(density, 1. / 30) == Approx(expected).epsilon(.1));
  CHECK(largest_energy(10, 1. / 60) == Approx(expected).epsilon(.1));
}
