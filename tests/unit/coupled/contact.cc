// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <undine/solid/solid_columns.h>

#include <message_of.h>

using namespace undine_tests;

namespace
{
  /// A ball of radius .1 at `centre`, of 0.3 m/s by `velocity`, softer or stiffer.
  template <int dim>
  std::string
  ball(const std::string &name,
       const std::string &centre,
       const std::string &velocity,
       const std::string &more = "")
  {
    return body(name,
                "set Shape = ball\nset Radius = .1\nset Centre = " + centre +
                  "\nset Initial velocity = " + velocity +
                  "\nset Density = 1000\nset Young's modulus = 2e4\nset Poisson's ratio = .3\n"
                  "set Refinements = " +
                  plane_or_space<dim>("2", "1") + "\n" + more);
  }


  template <int dim>
  std::string
  floor_at_zero(const std::string &more = "")
  {
    return section(
      "Effects",
      section("contact",
              section("Walls",
                      section("floor",
                              plane_or_space<dim>("set Point = 0, 0\nset Normal = 0, 2",
                                                  "set Point = 0, 0, 0\nset Normal = 0, 2, 0")))) +
        more);
  }


  template <int dim>
  double
  energy(const CoupledRun<dim> &run)
  {
    return run.column("solid kinetic energy") + run.column("solid elastic energy") +
           run.column("contact energy") + run.column("solid load potential");
  }


  /// What a run did.
  struct Course
  {
    double       start          = 0;
    double       largest_energy = 0;
    double       last_energy    = 0;
    double       least_gap      = 1;
    unsigned int most_contacts  = 0;
  };


  template <int dim>
  Course
  observe(CoupledRun<dim> &run, const unsigned int n_steps)
  {
    Course course;
    course.start = course.largest_energy = energy(run);
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        run.step();
        course.last_energy    = energy(run);
        course.largest_energy = std::max(course.largest_energy, course.last_energy);
        course.least_gap      = std::min(course.least_gap, run.column("least gap"));
        course.most_contacts =
          std::max(course.most_contacts, unsigned(run.column("nodes in contact")));
      }
    return course;
  }


  template <int dim>
  void
  check_drop(const double dt, const unsigned int n_steps, const double least_speed)
  {
    INFO(dim << "D, steps of " << dt);
    CoupledRun<dim> run(steps_of(dt) + section("Output", "set Ledger = true") +
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
    CHECK(run.column("energy closure") < 1e-9);
    CHECK(run.column("momentum closure") < 1e-9);
    // Without friction.
    CHECK(std::abs(run.column("solid momentum x")) < 1e-3 * std::abs(momentum));
  }


  template <int dim>
  void
  check_collision(const double dt, const unsigned int n_steps)
  {
    INFO(dim << "D, steps of " << dt);
    CoupledRun<dim> run(
      steps_of(dt) + section("Output", "set Ledger = true") +
      section("Bodies",
              ball<dim>("fast", plane_or_space<dim>("-.15, 0", "-.15, 0, 0"), "1") +
                ball<dim>("slow",
                          plane_or_space<dim>(".1, .05", ".1, .05, .03"),
                          plane_or_space<dim>("-.2; 0", "-.2; 0; 0"),
                          "set Young's modulus = 4e4\n")) +
      section("Effects", section("contact", "")));
    dealii::Tensor<1, dim> before;
    for (unsigned int axis = 0; axis < dim; ++axis)
      before[axis] = run.column(std::string("solid momentum ") + "xyz"[axis]);
    const auto course = observe(run, n_steps);
    CHECK(course.most_contacts > 0);
    CHECK(course.least_gap > 0);
    CHECK(course.largest_energy <= course.start * (1 + 1e-9));
    for (unsigned int axis = 0; axis < dim; ++axis)
      CHECK(std::abs(run.column(std::string("solid momentum ") + "xyz"[axis]) - before[axis]) <
            1e-10 * before.norm());
    CHECK(run.column("energy closure") < 1e-9);
    // They part: the centres go away from each other.
    CHECK(run.column("centre of mass slow x") - run.column("centre of mass fast x") > .19);
    CHECK(run.column("nodes in contact") == 0);
  }
} // namespace


TEST_CASE("a ball bounces off a wall and gains no energy", "[contact]")
{
  check_drop<2>(.004, 100, .5);
  check_drop<2>(.04, 12, .0);
  check_drop<3>(.01, 40, .3);
}


TEST_CASE("balls that collide keep their momentum and gain no energy", "[contact][mpi]")
{
  check_collision<2>(.004, 75);
  check_collision<2>(.03, 12);
  check_collision<3>(.01, 30);
}


TEST_CASE("no step is so long that bodies pass a wall or each other", "[contact]")
{
  for (const double dt : {.1, 1., 10.})
    {
      CoupledRun<2> run(
        steps_of(dt) +
        section("Bodies",
                ball<2>("low", "0, .12", "0; -1") + ball<2>("high", "0.02, .35", "0; -3")) +
        floor_at_zero<2>());
      const auto course = observe(run, 3);
      INFO("steps of " << dt);
      CHECK(course.least_gap > 0);
      CHECK(course.largest_energy <= course.start * (1 + 1e-9));
      CHECK(run.column("centre of mass low y") > .05);
      CHECK(run.column("centre of mass high y") > run.column("centre of mass low y"));
    }
}


TEST_CASE("without a touch contact changes nothing, to the bit", "[contact]")
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
  CoupledRun<2>     run(steps_of(.02) + section("Bodies", ball<2>("ball", "0, .1005", "0; 0")) +
                    floor_at_zero<2>(gravity + section("damping", "set Mass coefficient = 20")));
  for (unsigned int n = 0; n < 150; ++n)
    run.step();
  const double weight =
    9.81 * 1000 * run.column("volume ball") / (1 + run.column("volume drift ball"));
  CHECK(run.column("contact force ball y") == Approx(weight).epsilon(1e-6));
  CHECK(run.column("max speed ball") < 1e-6);
}


TEST_CASE("what contact cannot do is refused with a hint", "[contact]")
{
  using Catch::Contains;
  const auto why = [](const std::string &bodies, const std::string &effects) {
    return message_of([&] {
      CoupledRun<2>                    run(steps_of(.01) + bodies + effects);
      typename Effect<2>::Surroundings around{
        nullptr, run.models.solid.get(), false, {"contact"}, {}};
      run.models.effects[0]->check(run.options.section("Effects").section("contact"), around);
    });
  };
  CHECK_THAT(why(section("Bodies", ball<2>("low", "0, .05", "0; 0")), floor_at_zero<2>()),
             Contains("body 'low' is not on the free side of wall 'floor'") && Contains("Try"));
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
