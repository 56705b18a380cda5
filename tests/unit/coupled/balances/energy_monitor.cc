// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/budget/energy_monitor.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <coupled/coupled_run.h>

#include <algorithm>
#include <cmath>

using namespace undine_tests;

namespace
{
  /// What steps create by (B3), less what the budget says of it: the changes of energy that are no
  /// work of a force from outside, of which the monitor knows the kinetic energy of fluid that
  /// surfaces make way for. The sum of its size over a tenth of a second, after the first
  /// twentieth, over the energy at the end [1]. Without convection.
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
        const auto &after   = *run.state.account;
        double      created = after.energy - before.energy - after.work -
                         run.report.dt / 2 * (before.power + after.power);
        for (const auto &column : run.report.columns)
          for (const auto &term : {"boundary values", "integrator", "damping"})
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
        creations += run.report.creations.number;
        warnings += run.report.warnings.size();
      }
    return most / start;
  }
} // namespace


TEST_CASE("Walls at rest put in no energy, whatever friction does between them", "[coupled]")
{
  // A sheet swings in viscous fluid that convection carries: all velocities are known before
  // pressures and bodies have acted on them.
  CoupledRun<2> run(
    steps_of(1. / 30) + section("Output", "set Energy account = true") +
    section("Domain", "set Cells = 12, 13") + section("Fluid", "set Density = 1") +
    section("Effects",
            section("viscosity", "set Dynamic viscosity = 1e-3") + section("convection", "")) +
    section("Bodies",
            body("sheet",
                 "set Lower corner = .45, 0\nset Upper corner = .52, .6\nset Cells = 1, 6\n"
                 "set Density = 100\nset Young's modulus = 1e6\nset Poisson's ratio = .3\n"
                 "set Initial velocity = 20*y; 0",
                 clamp("foot", "1", "set Sides = bottom"))));
  const double energy = run.column("solid kinetic energy");
  for (unsigned int n = 0; n < 6; ++n)
    {
      run.step();
      CHECK(std::abs(run.column("energy put in")) < 1e-3 * energy);
      CHECK(run.column("energy exchanged") < 1e-3 * energy);
    }
}


TEST_CASE("Without convection bodies that give way to fluid let its kinetic energy in", "[coupled]")
{
  // A light disc that rises and vibrates: the fluid's volume changes where it is fast, and it
  // flows in and out where it is slow. What is left of the account is what the integrator takes.
  const auto created = [](const std::string &step, const std::string &cells) {
    CoupledRun<2> run(
      section("Time", "set Step = " + step) + section("Output", "set Energy account = true") +
      section("Domain", "set Cells = " + cells) +
      section("Fluid",
              "set Density = 1000\n" +
                section("Boundaries", boundary("surface", "top", "pressure", "set Pressure = 0"))) +
      section("Bodies",
              body("disc",
                   "set Shape = ball\nset Centre = .5, .22\nset Radius = .12\n"
                   "set Refinements = 2\nset Density = 100\nset Young's modulus = 1e5\n"
                   "set Poisson's ratio = .3")) +
      section("Solid numerics", "set Element degree = 1") +
      section("Effects", section("gravity", "set Acceleration = 0, -9.81")));
    double most = 0, largest = 0;
    while (run.state.clock.time < .4 - 1e-9)
      {
        run.step();
        CHECK(run.report.cuts == 0);
        most    = std::max(most, run.column("energy created"));
        largest = std::max(largest, run.column("energy"));
      }
    CHECK(largest > 80);
    return most / largest;
  };
  CHECK(created("1/60", "48, 48") < 1e-4); // .01 without
  CHECK(created("1/120", "32, 32") < 1e-4);
}


TEST_CASE("What fluid brings in through an opening counts, whatever form convection has",
          "[coupled]")
{
  // A pressure that sets in drives fluid through a channel. Implicit Euler creates nothing.
  for (const std::string &integrator : {"trapezoid_bdf2", "theta\nset Theta = 1"})
    for (const std::string &form : {"flux", "along paths"})
      {
        INFO(integrator << ", " << form);
        CoupledRun<2> run(
          section("Time", "set Step = 1/60\nset Integrator = " + integrator) +
          section("Output", "set Energy account = true") + section("Domain", "set Cells = 9, 8") +
          section("Fluid",
                  "set Density = 1\n" +
                    section("Boundaries",
                            boundary("in", "left", "pressure", "set Pressure = 2*min(1, 5*t)") +
                              boundary("out", "right", "outflow", "set Region = y - .5"))) +
          section("Effects",
                  section("viscosity", "set Dynamic viscosity = 1e-3") +
                    section("convection", "set Form = " + form)));
        double brought = 0;
        for (unsigned int n = 0; n < 60; ++n)
          {
            run.step();
            brought += run.column("energy put in");
            CHECK(run.report.cuts == 0);
          }
        CHECK(run.column("Fluid kinetic energy") > .4);
        CHECK(run.column("Fluid kinetic energy") == Approx(brought).epsilon(.1));
      }
}


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
    // Without convection what comes in fast and leaves slowly brings in no kinetic energy, but
    // where the knob makes way there is fluid, which moves. The flux of its energy is of first
    // order in the cells: 16 of them leave .011.
    check_powers<2>(
      section("Domain", "set Cells = 32, 32") +
      section("Fluid",
              "set Density = 1000\n" +
                section("Boundaries",
                        boundary("in", "left", "inflow", "set Velocity = .3 + t; 0") +
                          boundary("out", "right", "outflow", "set Region = y - .5"))) +
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
        created += run.report.share_created;
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
    CHECK(std::abs(run.report.share_created) < 1e-9);
  }
}


TEST_CASE("Walls that move put in the work of their friction, also where they start at once",
          "[energy][mpi]")
{
  // The layer that the lid drags along in the first step is as thin as cells next to it.
  const std::string grading = "0.5 - 0.5*cos(pi*x)";
  for (const std::string &body : {"", "knob"})
    {
      INFO(body);
      CoupledRun<2> run(
        steps_of(0.4) +
        section("Domain",
                "set Cells = 16, 16\nset Grading x = " + grading + "\nset Grading y = " + grading) +
        section("Fluid",
                "set Density = 1\n" +
                  section("Boundaries",
                          boundary("lid", "top", "moving wall", "set Velocity = 1; 0") +
                            boundary("walls", "left, right, bottom", "no-slip wall"))) +
        (body.empty()
           ? ""
           : section("Obstacles",
                     section(body, "set Shape = ball\nset Centre = .5, .2\nset Radius = .1"))) +
        section("Effects", convection() + viscosity(1e-3)));
      for (unsigned int step = 0; step < 4; ++step)
        {
          run.step();
          CHECK(run.report.cuts == 0);
          CHECK(run.state.account->power == Approx(-run.column("Viscous force on lid, x")));
          CHECK(run.report.share_created <= 0);
        }
    }
}


TEST_CASE("The first step is judged where all work follows from the way of bodies", "[coupled]")
{
  // A ball that spins and vibrates, in a step that does not resolve it: this integrator gains.
  const auto scene = [](const std::string &response) {
    return section("Time",
                   "set Step = 1/30\nset Integrator = newmark\nset Gamma = 0.5\n"
                   "set Energy monitor = " +
                     response) +
           section("Bodies",
                   section("ball",
                           "set Shape = ball\nset Centre = 0, 0, 0\nset Radius = .1\n"
                           "set Density = 1000\nset Young's modulus = 1e5\n"
                           "set Poisson's ratio = .3\n"
                           "set Initial displacement = .3*x; -.1*y; -.1*z\n"
                           "set Initial velocity = -10*y; 10*x; 0")) +
           section("Effects", section("damping", "set Stiffness coefficient = 1e-3"));
  };
  const auto gain = [](CoupledRun<3> &run) {
    const auto energy = [&] {
      return run.column("solid kinetic energy") + run.column("solid elastic energy");
    };
    const double start = energy();
    run.step();
    return energy() / start - 1;
  };
  CoupledRun<3> off(scene("off")), redone(scene("redo"));
  const double  unwatched = gain(off);
  CHECK(unwatched > 1); // else this tests nothing
  CHECK(gain(redone) <= 0.1);
  CHECK(redone.report.creations.number > 0);
}


TEST_CASE("Where shorter steps create no less the one that creates least is accepted", "[coupled]")
{
  // What steps of the asked length, of half of it, and so on create: the one that is accepted.
  const auto accepted = [](const std::vector<double> &created) {
    const Options options = read_scene_text("");
    EnergyMonitor monitor;
    monitor.add_options(options.section("Time"), EnergyMonitor::Response::redo);
    State<2> state;
    state.account.emplace();
    state.account->energy = state.account->largest = 1;
    state.account->known                           = true;
    Report report;
    for (unsigned int tries = 0; tries < 20; ++tries)
      {
        report.dt = 1. / (1u << report.halvings);
        monitor.begin_step(state, report);
        report.columns = {{"solid kinetic energy", "J", 1 + created[report.halvings]}};
        try
          {
            monitor.judge(state, report, report.halvings + 1 < created.size());
            CHECK(report.creations.number == tries);
            return report.halvings;
          }
        catch (const EnergyMonitor::NoShorterStep &)
          {
            report.halvings = report.creations.best_halvings;
          }
        catch (const SolveError &)
          {
            ++report.halvings;
          }
      }
    FAIL("no end");
    return 0u;
  };
  CHECK(accepted({.001, 9, 9, 9, 9}) == 0); // a thousandth is allowed
  CHECK(accepted({.2, .001, 9, 9, 9}) == 1);
  CHECK(accepted({.2, .05, 9, 9, 9}) == 1);      // too much for all steps, but two more are in vain
  CHECK(accepted({.2, .19, .18, .001, 9}) == 3); // goes on while one step creates too much
  CHECK(accepted({.2, .3, .4, .5, .6}) == 0);    // the first was the best
  CHECK(accepted({.2, .09, .12, .13, .001}) == 1);
  CHECK(accepted({.05, .03, .04, .001, 0}) == 0); // two in vain
}


TEST_CASE("Fluid that a thin body hides from where it was does not take the body's velocity",
          "[coupled]")
{
  // Two thin sheets that shake in long steps: one crosses the middle of a face of the grid.
  const auto sheet = [](const std::string &name, const std::string &keys, const double load) {
    return body(name,
                keys + fmt::format("set Density = 144.7\nset Young's modulus = 192.9\n"
                                   "set Poisson's ratio = 0.2822\nset Load = {}; 0",
                                   load),
                section("foot", "set Kind = clamp\nset Where = -y"));
  };
  CoupledRun<2> run(
    section("Time", "set Step = 1/15\nset Energy monitor = off") +
    section("Domain", "set Cells = 31, 16") +
    section(
      "Fluid",
      "set Density = 1000\n" +
        section("Boundaries", boundary("opening", "top", "pressure", "set Pressure = 49.26"))) +
    section("Effects",
            section("gravity", "set Acceleration = 0, -0.04926") + section("contact", "") +
              section("damping", "set Stiffness coefficient = 0.003772")) +
    section("Bodies",
            sheet("left",
                  "set Lower corner = 0.38709677, -0.05340604\n"
                  "set Upper corner = 0.38953473, 0.58746646\nset Cells = 1, 12\n",
                  49.257) +
              sheet("right",
                    "set Lower corner = 0.61290323, -0.03261932\n"
                    "set Upper corner = 0.61534118, 0.48928975\nset Cells = 1, 16\n",
                    -49.257)) +
    section("Output", "set Budget = true"));
  double gained = 0, largest = 0;
  while (run.state.clock.time < 0.6 - 1e-9)
    {
      run.step();
      gained += std::max(0., run.column("energy by transport"));
      largest = std::max(largest,
                         run.column("Fluid kinetic energy") + run.column("solid elastic energy") +
                           run.column("solid kinetic energy"));
    }
  CHECK(largest > 0.02);
  CHECK(gained < 0.01 * largest);
}


TEST_CASE("Thin sheets at rest in a fluid stay so in steps that do not resolve them", "[coupled]")
{
  // The grid is cut where bodies are expected. Sheets of a twentieth of a cell that end a stage a
  // tenth of a cell from there shake, and gain as much as all loads have done.
  const auto sheet =
    [](const std::string &name, const std::string &corners, const unsigned int cells) {
      return body(name,
                  corners + fmt::format("set Cells = 1, {}\nset Density = 185.2\n"
                                        "set Young's modulus = 1.602e6\n"
                                        "set Poisson's ratio = 0.05092",
                                        cells),
                  section("foot", "set Kind = clamp\nset Where = -y"));
    };
  CoupledRun<2> run(
    section("Time", "set Step = 1/15\nset Energy monitor = off") +
    section("Domain", "set Cells = 35, 36") +
    section("Fluid",
            "set Density = 1000\n" +
              section("Boundaries", boundary("opening", "top", "pressure", "set Pressure = 413"))) +
    section("Effects",
            section("gravity", "set Acceleration = 0, -0.413") + section("contact", "")) +
    section("Bodies",
            sheet("left",
                  "set Lower corner = 0.401854, -0.040243\n"
                  "set Upper corner = 0.403385, 0.523162\n",
                  14) +
              sheet("right",
                    "set Lower corner = 0.562373, -0.030782\n"
                    "set Upper corner = 0.563904, 0.492520\n",
                    17)));
  double largest = 0;
  while (run.state.clock.time < 1.66)
    {
      run.step();
      if (run.state.clock.time > 0.2)
        largest = std::max(largest, run.column("Fluid kinetic energy"));
    }
  CHECK(largest < 0.05 * run.column("solid elastic energy"));
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


TEST_CASE("A support that jumps puts its work into bodies without inertia", "[energy][mpi]")
{
  CoupledRun<2> run(
    section("Time", "set Step = .1\nset Integrator = static") +
    section("Bodies",
            body("bar",
                 "set Upper corner = 1, .2\nset Cells = 4, 1\nset Density = 1000\n"
                 "set Young's modulus = 1e6\nset Poisson's ratio = .3\n" +
                   section("Boundaries",
                           boundary("wall", "left", "clamp") +
                             boundary("press",
                                      "right",
                                      "prescribed motion",
                                      "set Displacement = .01 + if(t > .25, .02, 0) - "
                                      "if(t > .45, .025, 0); 0")))));
  for (unsigned int n = 0; n < 6; ++n)
    {
      run.step();
      INFO("step " << n);
      CHECK(run.report.cuts == 0);
      CHECK(run.report.warnings.empty());
    }
}
