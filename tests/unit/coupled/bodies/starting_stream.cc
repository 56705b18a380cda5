// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  constexpr double height = .5;

  constexpr double thickness =
    .0002; // as good as none: a blunt edge holds up more than a sharp one

  /// A thin stiff sheet of half the height of a channel of height 1, whose stream starts from rest
  /// with an acceleration of 1 m/s^2, without convection. It stands at the same place in a cell of
  /// whatever size.
  std::string
  channel(const unsigned int cells_across)
  {
    return steps_of(1e-2) +
           section(
             "Domain",
             fmt::format("set Lower corner = -2, 0\nset Upper corner = 2, 1\nset Cells = {}, {}",
                         4 * cells_across,
                         cells_across)) +
           section("Fluid",
                   "set Density = 1000\n" +
                     section("Boundaries",
                             boundary("in", "left", "inflow", "set Velocity = t; 0") +
                               boundary("out", "right", "outflow"))) +
           section(
             "Bodies",
             body("sheet",
                  fmt::format("set Lower corner = {0}, -.05\nset Upper corner = {0} + {1}, {2}\n"
                              "set Cells = 1, 11\nset Density = 1000\n"
                              "set Young's modulus = 2.5e18\nset Poisson's ratio = 0",
                              .3 / cells_across,
                              thickness,
                              height),
                  clamp("foot", "-y"))) +
           section("Time", "set Integrator = theta\nset Theta = 1");
  }


  /// Added mass of a barrier on the floor of a channel of height 1, per depth, potential flow
  /// [kg/m]:
  ///
  ///     F = rho (4/pi) ln sec(pi a/2) dU/dt,    a = its height
  ///
  /// since a gap of 1 - a holds up a stream as much as (4/pi) ln sec(pi a/2) of channel more would;
  /// and the mass of the water in whose place the sheet stands.
  double
  exact_force()
  {
    return 1000 * (4 / M_PI * std::log(1 / std::cos(M_PI * height / 2)) + height * thickness);
  }


  double
  error_of_force(const unsigned int cells_across)
  {
    CoupledRun<2> run(channel(cells_across));
    for (unsigned int n = 0; n < 10; ++n)
      run.step();
    return run.column("pressure force sheet x") / exact_force() - 1;
  }
} // namespace


TEST_CASE("A stream that starts pushes a sheet with the exact force", "[coupled]")
{
  const double coarse = error_of_force(20), middle = error_of_force(40), fine = error_of_force(80);
  INFO(fmt::format("{:.2e} {:.2e} {:.2e}", coarse, middle, fine));
  CHECK(std::abs(fine) <= .03);
  CHECK(std::abs(coarse / middle) >= 1.7);
  CHECK(std::abs(middle / fine) >= 1.8);
  // To first order in the width of cells there remains
  CHECK(std::abs(2 * fine - middle) <= .0015);
}
