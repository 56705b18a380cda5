// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  /// A ball that swings in a fluid without friction, which can exchange momentum with nothing else
  /// along the first axis. In steps of `dt`.
  template <int dim>
  std::string
  swinging_ball(const unsigned int n, const double dt, const std::string &form)
  {
    return steps_of(dt) +
           section("Domain",
                   fmt::format(
                     plane_or_space<dim>("set Cells = {0}, {0}", "set Cells = {0}, {0}, {0}"), n)) +
           section("Fluid",
                   "set Density = 1\nset Initial velocity = " +
                     plane_or_space<dim>("sin(2*pi*y); .3", "sin(2*pi*y); .3; .1") + "\n" +
                     section("Boundaries", boundary("around", every_side<dim>(), "periodic"))) +
           section(
             "Obstacles",
             obstacle("ball",
                      "ball",
                      plane_or_space<dim>(
                        "set Centre = .503, .511\nset Radius = .2\nset Refinements = 4\n"
                        "set Displacement = .1*(1-cos(2*pi*t)); 0",
                        "set Centre = .503, .511, .497\nset Radius = .23\n"
                        "set Refinements = 3\nset Displacement = .1*(1-cos(2*pi*t)); 0; 0"))) +
           section("Effects", form) + section("Output", "set Budget = true");
  }


  /// What of the momentum that the ball gives the fluid does not get, or gets besides, in a period,
  /// in proportion to all that is exchanged.
  template <int dim>
  double
  lost(const std::string &scene)
  {
    CoupledRun<dim> run(scene);
    double          sum = 0, exchanged = 0;
    while (run.state.clock.time < 1 - 1e-9)
      {
        run.step();
        const double given = run.column("momentum by obstacles x");
        sum += given - run.column("momentum gain x");
        exchanged += std::abs(given);
      }
    return std::abs(sum) / exchanged;
  }
} // namespace


TEST_CASE("Convection in flux form leaves the fluid the momentum that an obstacle has given it",
          "[coupled][mpi]")
{
  // The ball crosses up to 1.3 cells in a step, the flow up to 3.7.
  SECTION("2D")
  {
    for (const double dt : {1. / 12, 1. / 25, 1. / 50})
      CHECK(lost<2>(swinging_ball<2>(24, dt, flux_form())) < 4e-3);
  }
  SECTION("3D")
  {
    CHECK(lost<3>(swinging_ball<3>(10, 1. / 25, flux_form())) < 4e-3);
  }
}
