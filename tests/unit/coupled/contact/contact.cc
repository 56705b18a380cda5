// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/contact/contact_course.h>

#include <undine/contact/barrier.h>

#include <message_of.h>

using namespace undine_tests;

namespace
{
  template <int dim>
  void
  check_drop(const double dt, const unsigned int n_steps, const double least_speed)
  {
    INFO(dim << "D, steps of " << dt);
    CoupledRun<dim> run(steps_of(dt) + elements<dim>() + section("Output", "set Budget = true") +
                        section("Bodies",
                                ball<dim>("ball",
                                          plane_or_space<dim>("0, .15", "0, .15, 0"),
                                          plane_or_space<dim>("0; -.5", "0; -.5; 0"))) +
                        floor_at_zero<dim>());
    const double    momentum = run.column("solid momentum y");
    const auto      course   = observe(run, n_steps);
    CHECK(course.most_contacts > 0);
    CHECK(course.least_gap > 0);
    CHECK(course.largest_energy <= course.start * (1 + 1e-9));
    CHECK(run.column("solid momentum y") > -least_speed * momentum);
    CHECK(course.energy_closure < 1e-9);
    CHECK(course.momentum_closure < 1e-9);
    // Without friction.
    CHECK(std::abs(run.column("solid momentum x")) < 1e-3 * std::abs(momentum));
  }
} // namespace


TEST_CASE("a ball bounces off a wall and gains no energy", "[contact]")
{
  check_drop<2>(.004, 80, .5);
  check_drop<2>(.04, 8, .0);
  check_drop<3>(.01, 30, .3);
}


TEST_CASE("balls that collide keep their momentum and gain no energy", "[contact][mpi]")
{
  check_collision<2>(.004, 75);
  check_collision<2>(.03, 12);
}


TEST_CASE("no step is so long that bodies pass a wall or each other", "[contact]")
{
  for (const double dt : {.1, 1.})
    {
      CoupledRun<2> run(
        steps_of(dt) + section("Output", "set Budget = true") +
        section("Bodies",
                ball<2>("low", "0, .12", "0; -.2") + ball<2>("high", "0.02, .35", "0; -.6")) +
        floor_at_zero<2>());
      const auto course = observe(run, 3);
      INFO("steps of " << dt);
      CHECK(course.least_gap > 0);
      CHECK(course.largest_energy <= course.start * (1 + 1e-9));
      CHECK(run.column("centre of mass low y") > .05);
      CHECK(run.column("centre of mass high y") > run.column("centre of mass low y"));
    }
}


TEST_CASE("without a touch contact does not change a bit", "[contact]")
{
  const auto state = [](const std::string &effects) {
    CoupledRun<2> run(steps_of(.01) + section("Bodies", ball<2>("ball", "0, .5", "1; -1")) +
                      effects);
    for (unsigned int n = 0; n < 5; ++n)
      run.step();
    return run.state.solid;
  };
  const auto with = state(floor_at_zero<2>()), without = state("");
  auto       difference = with.displacement;
  difference.add(-1., without.displacement);
  CHECK(difference.linfty_norm() == 0);
  difference = with.velocity;
  difference.add(-1., without.velocity);
  CHECK(difference.linfty_norm() == 0);
}


TEST_CASE("a ball at rest on a wall stays and weighs what it weighs", "[contact]")
{
  const std::string gravity = section("gravity", "set Acceleration = 0, -9.81");
  CoupledRun<2>     run(steps_of(.02) + section("Bodies", ball<2>("ball", "0, .101", "0; 0")) +
                    floor_at_zero<2>(gravity + section("damping", "set Mass coefficient = 20")));
  for (unsigned int n = 0; n < 150; ++n)
    run.step();
  const double weight =
    9.81 * 1000 * run.column("volume ball") / (1 + run.column("volume drift ball"));
  CHECK(run.column("contact force ball y") == Approx(weight).epsilon(1e-6));
  CHECK(run.column("max speed ball") < 1e-6);
}


/// A lid that moves as prescribed pushes a ball on the floor. In contact it keeps its velocity, and
/// nothing is missing in the sum of energies.
template <int dim>
static void
check_lid(const std::string &down, const double velocity_at_end)
{
  INFO(dim << "D, " << down);
  CoupledRun<dim> run(
    steps_of(.01) + elements<dim>() + budget + floor_at_zero<dim>() +
    section("Bodies",
            ball<dim>("ball",
                      plane_or_space<dim>("0, .12", "0, .12, 0"),
                      plane_or_space<dim>("0; 0", "0; 0; 0")) +
              body("lid",
                   plane_or_space<dim>("set Cells = 2, 1\nset Lower corner = -.2, .23\n"
                                       "set Upper corner = .2, .33\n",
                                       "set Cells = 2, 1, 2\nset Lower corner = -.2, .23, -.2\n"
                                       "set Upper corner = .2, .33, .2\n") +
                     "set Density = 1000\nset Young's modulus = 1e5\nset Poisson's ratio = .3",
                   section("top",
                           "set Sides = top\nset Kind = prescribed motion\nset Displacement = 0; " +
                             down + plane_or_space<dim>("", "; 0")))));
  double contacts = 0;
  for (unsigned int n = 0; n < 16; ++n)
    {
      run.step();
      INFO("step " << n + 1);
      contacts = std::max(contacts, run.column("nodes in contact"));
      CHECK(run.column("energy closure") <= 1e-9);
      CHECK(run.column("momentum closure") <= 1e-9);
      const auto &model = *run.models.solid;
      for (const auto &fixed : model.fixed())
        if (run.state.solid.velocity.in_local_range(fixed.dof) &&
            model.prescribed_displacement(fixed, .1) != 0)
          CHECK(run.state.solid.velocity(fixed.dof) ==
                Approx(model.prescribed_displacement(fixed, run.state.clock.time + 1e-4) / 2e-4 -
                       model.prescribed_displacement(fixed, run.state.clock.time - 1e-4) / 2e-4)
                  .epsilon(1e-3)
                  .margin(1e-4 * velocity_at_end));
    }
  CHECK(contacts > 0);
}


TEST_CASE("a support that moves keeps its velocity in contact, and its work is accounted for",
          "[contact][mpi]")
{
  check_lid<2>("-.2*t", .2);
  check_lid<2>("-.02*sin(20*t)", .4);
  check_lid<3>("-.02*sin(20*t)", .4);
}


TEST_CASE("contact goes with every integrator of one stage", "[contact]")
{
  for (const std::string integrator : {"theta", "newmark", "generalised_alpha"})
    {
      INFO(integrator);
      CoupledRun<2> run(
        section("Time", "set Step = .01\nset Integrator = " + integrator) +
        section("Output", "set Budget = true") +
        section("Bodies",
                ball<2>("fast", "-.15, .2", "1; 0") + ball<2>("slow", ".1, .25", "-.2; 0")) +
        floor_at_zero<2>());
      const double momentum = run.column("solid momentum x");
      const auto   course   = observe(run, 30);
      CHECK(course.most_contacts > 0);
      CHECK(course.least_gap > 0);
      CHECK(course.energy_closure < 1e-9);
      CHECK(run.column("solid momentum x") == Approx(momentum).epsilon(1e-10));
      CHECK(course.largest_energy <= course.start * (1 + 1e-9));
    }
}


TEST_CASE("the pressure under a disk pressed on a plane is that of Hertz", "[contact]")
{
  // Plane strain, E' = E / (1 - nu^2): under the force F the largest pressure is
  // (F E' / (pi R))^1/2 [Johnson, Contact Mechanics, 1985, section 4.2]. Here it is what the
  // barrier has at the least gap. The contact is five facets to each side, a quarter of the radius.
  const double modulus = 1e5, ratio = .3, distance = .002, stiffness = 1e6;
  // Linear elements: the middles of straight quadratic sides would not be on the circle.
  CoupledRun<2> run(
    section("Time", "set Step = 1\nset Integrator = static") +
    section("Solid numerics", "set Element degree = 1") +
    section("Bodies",
            body("disk",
                 fmt::format("set Shape = ball\nset Centre = 0, 1.002\nset Density = 1\nset "
                             "Young's modulus = {}\nset Poisson's ratio = {}\nset Material = "
                             "linear elastic\nset Refinements = 4\n",
                             modulus,
                             ratio),
                 section("top",
                         "set Kind = prescribed motion\nset Where = y - 1.95\nset Displacement = "
                         "0; -.02 * t"))) +
    section("Effects",
            section("contact",
                    fmt::format(
                      "set Activation distance = {}\nset Stiffness = {}\n", distance, stiffness) +
                      section("Walls", section("plane", "set Point = 0, 0\nset Normal = 0, 1")))));
  for (unsigned int n = 0; n < 6; ++n)
    run.step();
  const double force    = run.column("contact force disk y");
  const double pressure = -stiffness * barrier_slope(run.column("least gap") / distance);
  const double hertz    = std::sqrt(force * modulus / (1 - ratio * ratio) / dealii::numbers::PI);
  INFO(force << " N/m on " << run.column("nodes in contact") << " nodes");
  CHECK(pressure == Approx(hertz).epsilon(.05));
  CHECK(run.column("reaction disk/top y") == Approx(-force).epsilon(1e-7));
}


namespace
{
  /// A ball that weighs something in water falls to the floor of a tank: one that is lighter than
  /// water under a gravity that points upwards.
  CoupledRun<2>
  falling_in_water(const double density)
  {
    return CoupledRun<2>(
      steps_of(.02) + section("Output", "set Budget = true") +
      section("Domain", "set Cells = 16, 16") + section("Fluid", "set Density = 1000") +
      section("Bodies",
              body("ball",
                   fmt::format("set Shape = ball\nset Radius = .15\nset Centre = .47, .3\nset "
                               "Density = {}\nset Young's modulus = 1e6\nset Poisson's ratio = "
                               ".3\n",
                               density))) +
      section(
        "Effects",
        section("contact", "") +
          section("gravity",
                  std::string("set Acceleration = 0, ") + (density > 1000 ? "-9.81" : "9.81")) +
          convection()));
  }
} // namespace


TEST_CASE("a ball in a tank of water bounces off its floor", "[contact]")
{
  for (const double density : {3000., 300., 10.})
    {
      INFO(density << " kg/m^3");
      auto         run   = falling_in_water(density);
      double       least = 1, momentum = 0, lowest = 1, energy_in_flight = 0;
      unsigned int touches = 0;
      bool         rises   = false;
      while (run.state.clock.time < .48 - 1e-9)
        {
          run.step();
          least    = std::min(least, run.column("least gap"));
          momentum = std::max(momentum, run.column("momentum closure"));
          lowest   = std::min(lowest, run.column("centre of mass ball y"));
          touches += run.column("nodes in contact") > 0;
          rises = rises || (touches > 0 && run.column("solid momentum y") > 0);
          CHECK(run.column("Flagged cells") == 0);
          if (run.column("nodes in contact") == 0)
            energy_in_flight = run.column("solid kinetic energy");
        }
      CHECK(touches > 0);
      CHECK(least > 0);
      CHECK(lowest > .1);
      CHECK(momentum < 1e-9);
      // It sets out upwards again, with less than its weight in water has given it.
      CHECK(rises);
      CHECK(energy_in_flight < std::abs(density - 1000) * .0707 * 9.81 * .15);
    }
}


TEST_CASE("what contact cannot do is refused with a hint", "[contact]")
{
  using Catch::Contains;
  const auto why = [](const std::string &bodies, const std::string &effects) {
    return message_of([&] {
      CoupledRun<2>                    run(steps_of(.01) + bodies + effects);
      constexpr bool                   has_immersed_surfaces = false;
      typename Effect<2>::Surroundings around{
        nullptr, run.models.solid.get(), has_immersed_surfaces, {"contact"}, {}};
      run.models.effects[0]->check(run.options.section("Effects").section("contact"), around);
    });
  };
  CHECK_THAT(why(section("Bodies", ball<2>("low", "0, .05", "0; 0")), floor_at_zero<2>()),
             Contains("body 'low' is not on the free side of wall 'floor'") && Contains("Try"));
  // A gap that is nothing but rounding is none.
  CHECK_THAT(why(section("Bodies", ball<2>("low", "0, .1 + 1e-13", "0; 0")), floor_at_zero<2>()),
             Contains("body 'low' is not on the free side of wall 'floor'"));
  CHECK_THAT(
    why(
      section("Bodies", ball<2>("one", "0, .2", "0; 0") + ball<2>("two", ".2 + 1e-13, .2", "0; 0")),
      floor_at_zero<2>()),
    Contains("overlaps"));
  CHECK_THAT(
    why(section("Bodies", ball<2>("one", "0, .2", "0; 0") + ball<2>("two", ".1, .2", "0; 0")),
        floor_at_zero<2>()),
    Contains("overlaps") && Contains("Try"));
  CHECK_THAT(why(section("Bodies", ball<2>("ball", "0, .2", "0; 0")) +
                   section("Solid numerics", "set Newton iterations = 1"),
                 floor_at_zero<2>()),
             Contains("converged") && Contains("Remove"));
  CHECK_THAT(
    why(
      section("Bodies", ball<2>("ball", "0, .2", "0; 0")),
      section("Effects",
              section("contact",
                      section("Walls", section("floor", "set Point = 0, 0\nset Normal = 0, 0"))))),
    Contains("no direction"));
  CHECK(why(section("Bodies", ball<2>("ball", "0, .2", "0; 0")), floor_at_zero<2>()) == "no error");
}


TEST_CASE("contact that pushes from the start is said to", "[contact]")
{
  using Catch::Contains;
  const auto notes = [](const std::string &centre) {
    const CoupledRun<2> run(steps_of(.01) + section("Bodies", ball<2>("ball", centre, "0; 0")) +
                            floor_at_zero<2>());
    std::string         text;
    for (const auto &warning : run.report.warnings)
      text += warning.text;
    return text;
  };
  CHECK_THAT(notes("0, .1 + 1e-4"),
             Contains("'ball' is 0.0001 m from wall 'floor'") && Contains("larger gap"));
  CHECK(notes("0, .2") == "");
}


TEST_CASE("supports that leave a body no room are said to", "[contact]")
{
  using Catch::Contains;
  // The ball's upper part is pushed through the floor within one step.
  CoupledRun<2> run(
    section("Time", "set Step = .1\nset Maximum cuts = 0") + floor_at_zero<2>() +
    section(
      "Bodies",
      section("ball",
              "set Shape = ball\nset Radius = .1\nset Centre = 0, .2\nset Density = 1000\nset "
              "Young's modulus = 2e4\nset Poisson's ratio = .3\n" +
                section("Boundaries",
                        section("push",
                                "set Kind = prescribed motion\nset Where = 1\nset "
                                "Displacement = 0; -2*t")))));
  CHECK_THAT(message_of([&] { run.step(); }),
             Contains("run into a body") && Contains("% leave a gap") && Contains("Try"));
}
