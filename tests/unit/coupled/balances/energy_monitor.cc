// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/model/fluid_quantities.h>

#include <coupled/coupled_run.h>

#include <algorithm>
#include <cmath>

using namespace undine_tests;

namespace
{
  /// What steps create by (B3), less what the budget says of it: the changes of energy that are no
  /// work of a force from outside. The sum of its size over a tenth of a second, after the first
  /// twentieth, over the energy at the end [1].
  template <int dim>
  double
  difference_from_budget(const std::string &scene, const unsigned int steps_per_second)
  {
    CoupledRun<dim> run(steps_of(1. / steps_per_second) + scene +
                        section("Output", "set Budget = true"));
    double          sum = 0;
    while (run.state.clock.time < 0.15 - 1e-9)
      {
        const auto before = *run.state.account;
        run.step();
        CHECK(run.report.cuts == 0);
        const auto &after = *run.state.account;
        double      created =
          after.energy - before.energy - run.report.dt / 2 * (before.power + after.power);
        for (const auto &column : run.report.columns)
          for (const auto &term : {"transport", "boundary values", "integrator", "damping"})
            if (column.name == std::string("energy by ") + term)
              created -= column.value;
        if (run.state.clock.time > 0.05 + 1e-9)
          sum += std::abs(created);
      }
    return sum / run.state.account->energy;
  }


  /// The monitor, which looks at both ends of a step only, and the budget, which follows its
  /// stages, differ by an error of second order in the step: the powers are complete. In fluids
  /// around surfaces that move, pressures have errors from how the grid is cut, which steps do not
  /// change.
  template <int dim>
  void
  check_powers(const std::string &scene)
  {
    const bool   has_fluid = scene.find("Fluid") != std::string::npos;
    const double coarse    = difference_from_budget<dim>(scene, 40);
    const double fine      = difference_from_budget<dim>(scene, 80);
    const double finest    = difference_from_budget<dim>(scene, 160);
    INFO(coarse << ", " << fine << ", " << finest);
    CHECK(finest < 1e-2);
    if (!has_fluid)
      CHECK(coarse / finest > 8);
  }


  std::string
  strip(const std::string &keys, const std::string &boundaries)
  {
    return section("Bodies",
                   body("strip",
                        "set Upper corner = .1, 1\nset Cells = 2, 10\nset Density = 1000\n"
                        "set Young's modulus = 1e6\nset Poisson's ratio = .3\n" +
                          keys,
                        boundaries));
  }


  /// A dry strip that swings from its foot, with an integrator that gains energy in long steps.
  std::string
  gaining(const std::string &response)
  {
    return section(
             "Time",
             "set Step = 1/60\nset Integrator = theta\nset Theta = 0.6\nset Energy monitor = " +
               response) +
           section("Bodies",
                   body("sheet",
                        "set Upper corner = .00042, 0.65\nset Cells = 1, 26\nset Density = 1100\n"
                        "set Young's modulus = 3e9\nset Poisson's ratio = 0.3\n"
                        "set Initial velocity = 2*y/0.65; 0",
                        clamp("foot", "1", "set Sides = bottom")));
  }


  /// The largest energy in 0.2 s over that at the start [1].
  double
  largest_gain(CoupledRun<2> &run, unsigned int &creations, unsigned int &warnings)
  {
    const auto energy = [&] {
      return run.column("solid kinetic energy") + run.column("solid elastic energy");
    };
    const double start = energy();
    double       most  = start;
    while (run.state.clock.time < 0.2)
      {
        run.step();
        most = std::max(most, energy());
        creations += run.report.creations;
        warnings += run.report.warnings.size();
      }
    return most / start;
  }
} // namespace


TEST_CASE("The energy monitor knows all powers", "[coupled]")
{
  const std::string gravity = section("gravity", "set Acceleration = 0, -3");
  const std::string foot    = clamp("foot", "1", "set Sides = bottom");
  const std::string push =
    section("top", "set Kind = traction\nset Sides = top\nset Traction = 2e4 * t; 0");
  SECTION("body force and traction")
  {
    check_powers<2>(strip("", foot + push) + section("Effects", gravity));
  }
  SECTION("follower pressure")
  {
    check_powers<2>(strip(
      "", foot + section("left", "set Kind = pressure\nset Sides = left\nset Pressure = 2e4 * t")));
  }
  SECTION("a support that moves")
  {
    check_powers<2>(strip("",
                          section("foot",
                                  "set Kind = prescribed motion\nset Sides = bottom\n"
                                  "set Displacement = .01 * (1 - cos(20 * t)); 0")));
  }
  SECTION("inflow, opening and an obstacle that moves, without convection")
  {
    check_powers<2>(section("Domain", "set Cells = 16, 16") +
                    section("Fluid",
                            "set Density = 1000\n" +
                              section("Boundaries",
                                      boundary("in", "left", "inflow", "set Velocity = .3 + t; 0") +
                                        boundary("out", "right", "outflow"))) +
                    section("Obstacles",
                            section("knob",
                                    "set Shape = ball\nset Centre = .5, .5\nset Radius = .2\n"
                                    "set Displacement = 0; .1 * sin(5 * t)")));
  }
  SECTION("a body in a fluid with gravity, which flows in and out")
  {
    check_powers<2>(
      section("Domain", "set Lower corner = -1, 0\nset Upper corner = 1, 1.5\nset Cells = 20, 15") +
      section("Fluid",
              "set Density = 1000\n" +
                section("Boundaries",
                        boundary("in", "left", "inflow", "set Velocity = .3 + t; 0") +
                          boundary("open", "top", "pressure", "set Pressure = 0"))) +
      strip("", foot + push) + section("Effects", gravity));
  }
  SECTION("a jet out of a box, which convection carries out")
  {
    CoupledRun<2> run(
      steps_of(1. / 40) + section("Domain", "set Cells = 16, 16") +
      section("Fluid",
              "set Density = 1000\n" +
                section("Boundaries",
                        boundary("in", "left", "inflow", "set Velocity = .5; 0") +
                          boundary("out", "right", "outflow", "set Region = .15 - abs(y - .5)"))) +
      section("Effects", convection()));
    double passing = 0, created = 0;
    while (run.state.clock.time < 1 - 1e-9)
      {
        run.step();
        if (run.state.clock.time < 0.5)
          continue;
        const double dt = run.report.dt;
        passing += dt * kinetic_energy_outflow(*run.models.fluid, run.state.fluid.velocity) /
                   run.state.account->energy;
        created += run.report.created_share;
      }
    CAPTURE(passing, created);
    CHECK(passing > 0.5);
    CHECK(std::abs(created) < 0.2 * passing);
  }
  SECTION("a falling block in space, exactly")
  {
    CoupledRun<3> run(
      steps_of(1. / 40) +
      section("Bodies",
              body("block",
                   "set Cells = 1, 1, 1\nset Density = 1000\nset Young's modulus = 1e6\n"
                   "set Poisson's ratio = .3")) +
      section("Effects", section("gravity", "set Acceleration = 0, 0, -9.81")));
    run.step();
    run.step();
    CHECK(run.state.account->energy > 100);
    CHECK(std::abs(run.report.created_share) < 1e-9);
  }
}


TEST_CASE("Steps that create energy are redone with shorter ones, with a warning, or not judged",
          "[coupled]")
{
  unsigned int  creations = 0, warnings = 0;
  CoupledRun<2> off(gaining("off"));
  const double  unwatched = largest_gain(off, creations, warnings);
  CHECK(unwatched > 3); // else this tests nothing
  CHECK(creations == 0);
  CHECK(warnings == 0);

  CoupledRun<2> warned(gaining("warn"));
  CHECK(largest_gain(warned, creations, warnings) == unwatched); // to the bit
  CHECK(creations == 0);
  CHECK(warnings > 0);

  CoupledRun<2> redone(gaining("redo"));
  CHECK(largest_gain(redone, creations, warnings) < 0.6 * unwatched);
  CHECK(creations > 0);
}
