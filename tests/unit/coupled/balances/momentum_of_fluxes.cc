// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <array>
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


  /// What of the momentum that the ball gives the fluid does not get, or gets besides, step by step
  /// in a period, in proportion to all that is exchanged.
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
        sum += std::abs(given - run.column("momentum gain x"));
        exchanged += std::abs(given);
      }
    return sum / exchanged;
  }


  /// Force of the pressure on a ball of the area 0.07 m^2 that moves along with a stream of the
  /// acceleration 2 m/s^2, from 0.1 to 0.4 s: its mean, and the root mean square of what it
  /// deviates from that of the displaced fluid, both in proportion to that.
  std::array<double, 2>
  force_in_accelerated_stream(const unsigned int steps)
  {
    CoupledRun<2> run(
      steps_of(0.4 / steps) + section("Domain", "set Upper corner = 2, 1\nset Cells = 24, 12") +
      section("Fluid",
              "set Density = 1\nset Initial velocity = 1; 0\n" +
                section("Boundaries",
                        boundary("in", "left", "inflow", "set Velocity = 1+2*t; 0") +
                          boundary("out", "right", "outflow") +
                          boundary("walls", "bottom, top", "slip wall"))) +
      section("Obstacles",
              obstacle("ball",
                       "ball",
                       "set Centre = .5, .503\nset Radius = .15\nset Refinements = 3\n"
                       "set Displacement = t + t^2; 0")) +
      section("Effects", flux_form()));
    const double exact = dealii::numbers::PI * 0.15 * 0.15 * 2;
    double       sum = 0, squares = 0, n = 0;
    while (run.state.clock.time < 0.4 - 1e-9)
      {
        run.step();
        if (run.state.clock.time < 0.1)
          continue;
        const double force = run.column("pressure force ball x") / exact;
        sum += force;
        squares += (force - 1) * (force - 1);
        ++n;
      }
    return {{sum / n, std::sqrt(squares / n)}};
  }
} // namespace


TEST_CASE("A body that moves along with an accelerated stream feels the weight of displaced fluid",
          "[coupled]")
{
  // Pressures act in volumes at the end of a step: in long ones the force is noisy.
  const auto coarse = force_in_accelerated_stream(32), fine = force_in_accelerated_stream(128);
  INFO(fmt::format(
    "means {:.4f} {:.4f}, deviations {:.4f} {:.4f}", coarse[0], fine[0], coarse[1], fine[1]));
  CHECK(std::abs(coarse[0] - 1) < 0.05);
  CHECK(std::abs(fine[0] - 1) < 0.02);
  CHECK(coarse[1] < 0.1);
  CHECK(fine[1] < 0.03);
}


TEST_CASE("Convection in flux form leaves the fluid the momentum that an obstacle has given it",
          "[coupled][mpi]")
{
  // The ball crosses up to 1.3 cells in a step, the flow up to 3.7.
  SECTION("2D")
  {
    for (const double dt : {1. / 12, 1. / 25, 1. / 50})
      CHECK(lost<2>(swinging_ball<2>(24, dt, flux_form())) < 1e-6);
  }
  SECTION("3D")
  {
    // Components whose volume is extrapolated to less than nothing may have no other to give to.
    CHECK(lost<3>(swinging_ball<3>(10, 1. / 25, flux_form())) < 5e-5);
  }
}
