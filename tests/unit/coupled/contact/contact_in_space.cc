// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/contact/contact_course.h>

using namespace undine_tests;

namespace
{
  /// A ball of 32 cells at rest above a floor, in steps of `dt` [s].
  template <int dim>
  void
  check_fall(const double dt, const unsigned int n_steps)
  {
    INFO(dim << "D, steps of " << dt);
    CoupledRun<dim> run(
      steps_of(dt) + elements<dim>() + section("Output", "set Budget = true") +
      section("Bodies",
              ball<dim>("ball",
                        plane_or_space<dim>("0, .115", "0, .115, 0"),
                        plane_or_space<dim>("0; 0", "0; 0; 0"),
                        2e4,
                        0)) +
      floor_at_zero<dim>(section(
        "gravity", "set Acceleration = " + plane_or_space<dim>("0, -9.81", "0, -9.81, 0"))));
    const double height = run.column("centre of mass ball y");
    const auto   course = observe(run, n_steps);
    CHECK(course.most_contacts > 0);
    CHECK(course.least_gap > 0);
    CHECK(course.energy_closure < 1e-9);
    CHECK(course.momentum_closure < 1e-9);
    // Of what it had above the place where it touches first.
    const double weight = 9.81 * 1000 * run.column("volume ball");
    CHECK(course.largest_energy - course.start < 1e-6 * weight * .015);
    // It goes up again, with less than it had.
    CHECK(run.column("solid momentum y") > 0);
    CHECK(run.column("centre of mass ball y") < height);
    CHECK(run.column("centre of mass ball y") > .1);
  }


  /// A cube with sides of .2, with `map` of its points; it may stand on an edge then.
  std::string
  cube_on_edge(const std::string &name, const std::string &map, const std::string &velocity)
  {
    return body(
      name,
      "set Lower corner = -.1, -.1, -.1\nset Upper corner = .1, .1, .1\nset Cells = 2, 2, "
      "2\nset Density = 1000\nset Young's modulus = 2e4\nset Poisson's ratio = .3\nset "
      "Map = " +
        map + "\nset Initial velocity = " + velocity);
  }


  /// A ball that sinks in a tank full of water, to a block that stands on its floor.
  template <int dim>
  CoupledRun<dim>
  sinking(const std::string &cells)
  {
    const auto corners = [](const std::string &plane, const std::string &space) {
      return plane_or_space<dim>(plane, space);
    };
    return CoupledRun<dim>(
      steps_of(.02) + elements<dim>() + section("Output", "set Budget = true") +
      section("Domain", "set Cells = " + cells) + section("Fluid", "set Density = 1000") +
      section("Bodies",
              body("ball",
                   "set Shape = ball\nset Radius = .2\nset Density = 3000\nset Young's modulus = "
                   "1e6\nset Poisson's ratio = .3\nset Centre = " +
                     corners(".47, .53", ".47, .53, .51"))) +
      section("Obstacles",
              obstacle("block",
                       "box",
                       "set Lower corner = " + corners(".22, -.1", ".22, -.1, .22") +
                         "\nset Upper corner = " + corners(".72, .26", ".72, .26, .74"))) +
      section("Effects",
              section("contact", "") + convection() +
                section("gravity", "set Acceleration = " + corners("0, -9.81", "0, -9.81, 0"))));
  }


  template <int dim>
  void
  check_sinking(const std::string &cells, const unsigned int n_steps)
  {
    INFO(dim << "D");
    auto         run   = sinking<dim>(cells);
    double       least = 1, closure = 0, lowest = 1;
    unsigned int touches = 0;
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        run.step();
        least   = std::min(least, run.column("least gap"));
        closure = std::max(closure, run.column("momentum closure"));
        lowest  = std::min(lowest, run.column("centre of mass ball y"));
        touches += run.column("nodes in contact") > 0;
        CHECK(run.column("Flagged cells") == 0);
      }
    CHECK(touches > 0);
    CHECK(least > 0);
    CHECK(closure < 1e-9);
    // Upon the block: its top and the radius, less what a soft ball gives way.
    CHECK(lowest > .26 + .16);
    CHECK(lowest < .26 + .21);
  }
} // namespace


TEST_CASE("a ball that falls on a floor bounces and gains no energy", "[contact]")
{
  check_fall<2>(.0025, 80);
  check_fall<3>(.0025, 90);
}


TEST_CASE("balls that collide in space keep their momentum and gain no energy", "[contact]")
{
  check_collision<3>(.005, 60, 0);
}


TEST_CASE("cubes whose edges cross bounce off each other", "[contact]")
{
  // Edges along y and x, nodes far from them.
  CoupledRun<3> run(
    steps_of(.004) + elements<3>() + section("Output", "set Budget = true") +
    section(
      "Bodies",
      cube_on_edge("low", "(x - z) / 2^.5; y; (x + z) / 2^.5", "0; 0; 0") +
        cube_on_edge("high", "x + .04; (y - z) / 2^.5 + .03; (y + z) / 2^.5 + .31", "0; 0; -.4")) +
    section("Effects", section("contact", "")));
  const double momentum = run.column("solid momentum z");
  const auto   course   = observe(run, 120);
  CHECK(course.most_contacts > 0);
  CHECK(course.least_gap > 0);
  CHECK(course.energy_closure < 1e-9);
  CHECK(course.largest_energy <= course.start * (1 + 1e-9));
  CHECK(run.column("solid momentum z") == Approx(momentum).epsilon(1e-10));
  CHECK(run.column("nodes in contact") == 0);
  CHECK(run.column("centre of mass high z") - run.column("centre of mass low z") > .31);
}


TEST_CASE("a ball in water sinks to an obstacle and does not enter it", "[contact]")
{
  check_sinking<2>("16, 16", 20);
  check_sinking<3>("8, 8, 8", 10);
}
