// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// Water, and in it the bodies, which sleep after a fifth of a second at less than 1 cm/s.
  CoupledRun<2>
  tank(const std::string &integrator, const bool is_open, const std::string &bodies)
  {
    return CoupledRun<2>(
      section("Time", "set Step = 1/60\nset Integrator = " + integrator) +
      section("Domain", "set Cells = 17, 18") +
      section(
        "Fluid",
        "set Density = 1000" +
          (is_open
             ? "\n" +
                 section("Boundaries",
                         section("top", "set Sides = top\nset Kind = pressure\nset Pressure = 0"))
             : std::string())) +
      section("Bodies", bodies) +
      section("Effects",
              section("contact", "set Activation distance = .008") +
                section("gravity", "set Acceleration = 0, -9.81") +
                section("viscosity", "set Dynamic viscosity = 1") +
                section("damping", "set Mass coefficient = 60\nset Stiffness coefficient = .003") +
                section("sleep", "set Speed = .01\nset Time = .2")));
  }


  std::string
  block(const std::string &name, const double low, const double density, const std::string &held)
  {
    return body(name,
                fmt::format("set Lower corner = .31, {}\nset Upper corner = .66, {}\n"
                            "set Cells = 2, 2\nset Density = {}\nset Young's modulus = 1e6\n"
                            "set Poisson's ratio = .3",
                            low,
                            low + .2,
                            density),
                held);
  }


  /// What wakes where nothing has happened does not move.
  void
  check_waking(CoupledRun<2> &run)
  {
    for (auto &load : run.state.sleep.loads)
      load = {};
    for (unsigned int n = 0; n < 3; ++n)
      {
        run.step();
        CHECK(run.column("asleep a") == 0);
        CHECK(run.column("max speed a") < 5e-4);
      }
  }


  /// In the end all bodies sleep, none wakes, and nothing moves.
  void
  check_sleep(const std::string &integrator, const bool is_open, const std::string &bodies)
  {
    INFO(integrator << (is_open ? ", open\n" : ", closed\n") << bodies);
    auto       run       = tank(integrator, is_open, bodies);
    const auto all_sleep = [&] {
      const auto &asleep = run.state.sleep.asleep;
      return !asleep.empty() && std::find(asleep.begin(), asleep.end(), false) == asleep.end();
    };
    while (run.state.clock.time < 1.5)
      run.step();
    REQUIRE(all_sleep());
    const auto   where = run.state.solid.displacement;
    const double force = run.column("pressure force a y");
    for (unsigned int n = 0; n < 60; ++n)
      {
        run.step();
        REQUIRE(all_sleep());
        CHECK(run.column("pressure force a y") == Approx(force).epsilon(.01));
        CHECK(run.column("Fluid kinetic energy") < 1e-3);
      }
    auto way = run.state.solid.displacement;
    way -= where;
    CHECK(way.linfty_norm() == 0);
    check_waking(run);
  }
} // namespace


TEST_CASE("bodies that lie in a tank sleep on", "[sleep][mpi]")
{
  const std::string clamped = section("foot", "set Kind = clamp\nset Sides = bottom");
  for (const std::string &integrator : {"trapezoid_bdf2", "theta"})
    {
      for (const bool is_open : {true, false})
        {
          check_sleep(integrator, is_open, block("a", .006, 3000, ""));
          check_sleep(integrator, is_open, block("a", 0, 100, clamped));
        }
      check_sleep(integrator, true, block("a", .006, 3000, "") + block("b", .213, 2000, ""));
    }
}
