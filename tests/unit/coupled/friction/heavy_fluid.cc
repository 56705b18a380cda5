// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <algorithm>
#include <cmath>

using namespace undine_tests;

namespace
{
  /// A plate across a column of viscous water, ten times as heavy as the plate, that gives way to
  /// its own weight.
  template <int dim>
  CoupledRun<dim>
  swinging_plate(const double dt, const double tolerance)
  {
    return CoupledRun<dim>(
      steps_of(dt) +
      section("Domain",
              plane_or_space<dim>("set Lower corner = 0, -.75\nset Upper corner = 1, 0\n"
                                  "set Cells = 24, 18",
                                  "set Lower corner = 0, -.75, 0\nset Upper corner = 1, 0, .25\n"
                                  "set Cells = 12, 9, 3")) +
      section(
        "Fluid",
        "set Density = 1000\n" +
          section("Boundaries",
                  boundary("surface", "top", "pressure", "set Pressure = 0") +
                    boundary("below", "bottom", "pressure", "set Pressure = 1000*9.81*.75"))) +
      section(
        "Bodies",
        body("plate",
             plane_or_space<dim>("set Lower corner = 0, -.54\nset Upper corner = 1, -.5\n"
                                 "set Cells = 16, 1\n",
                                 "set Lower corner = 0, -.54, 0\nset Upper corner = 1, -.5, .25\n"
                                 "set Cells = 8, 1, 1\n") +
               "set Density = 2000\nset Young's modulus = 1e8\nset Poisson's ratio = 0",
             clamp("ends", "1", "set Sides = left, right"))) +
      section("Effects",
              viscosity(1) + section("gravity",
                                     plane_or_space<dim>("set Acceleration = 0, -9.81",
                                                         "set Acceleration = 0, -9.81, 0"))) +
      section("Coupling", fmt::format("set Friction tolerance = {}", tolerance)));
  }


  struct Result
  {
    double friction     = 0; ///< along y, mean over the last third [N]
    double pressure     = 0; ///< the same of the pressure's force
    double solved_again = 0; ///< stages
  };

  template <int dim>
  Result
  within_a_tenth_of_a_second(const double dt, const double tolerance)
  {
    auto   run = swinging_plate<dim>(dt, tolerance);
    Result result;
    while (run.state.clock.time < .1 - 1e-9)
      {
        run.step();
        result.solved_again += run.column("Stages solved again");
        if (run.state.clock.time < .2 / 3 + 1e-9)
          continue;
        result.friction += run.column("viscous force plate y") * dt * 30;
        result.pressure += run.column("pressure force plate y") * dt * 30;
      }
    return result;
  }


  /// `noise`: by which share of the pressure's force friction fluctuates as the plate moves.
  template <int dim>
  void
  check_friction(const double noise)
  {
    const auto exact = within_a_tenth_of_a_second<dim>(1. / 480, 0);
    for (const double dt : {1. / 60, 1. / 120})
      {
        const auto once  = within_a_tenth_of_a_second<dim>(dt, 1e9);
        const auto twice = within_a_tenth_of_a_second<dim>(dt, 0);
        INFO(dim << "D, " << dt << " s: " << once.friction << " " << twice.friction << ", "
                 << exact.friction << " N; " << once.solved_again << " " << twice.solved_again
                 << " stages again");
        CHECK(once.solved_again < twice.solved_again);
        const auto error = [&](const Result &of) { return std::abs(of.friction - exact.friction); };
        CHECK(error(twice) <= std::max(error(once) / 5, noise * exact.pressure));
        CHECK(error(once) <= 5e-3 * exact.pressure);
      }
  }
} // namespace


TEST_CASE("Friction on a body knows how heavy the fluid is that it has to move", "[friction]")
{
  check_friction<2>(0);
  check_friction<3>(5e-4);
}
