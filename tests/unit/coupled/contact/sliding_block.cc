// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  constexpr double speed = .1;

  /// A block that slides along the floor of a closed tank, a thousandth of its length above it,
  /// past planes of the grid; at the start its left side is at `left`.
  template <int dim>
  CoupledRun<dim>
  block_on_the_floor(const double       density,
                     const double       dt,
                     const double       left,
                     const std::string &effects)
  {
    const auto corner = [](const double x, const double y) {
      return fmt::format(plane_or_space<dim>("{0}, {1}", "{0}, {1}, .3"), x, y);
    };
    const auto upper_corner = [](const double x, const double y) {
      return fmt::format(plane_or_space<dim>("{0}, {1}", "{0}, {1}, .7"), x, y);
    };
    return CoupledRun<dim>(
      budget + steps_of(dt) +
      section("Domain",
              plane_or_space<dim>("set Cells = 14, 17",
                                  "set Lower corner = 0, 0, 0\nset Upper corner = 1, 1, 1\n"
                                  "set Cells = 10, 9, 7")) +
      section("Fluid", "set Density = 1000") + section("Solid numerics", "set Element degree = 1") +
      section("Bodies",
              body("block",
                   fmt::format("set Lower corner = {}\nset Upper corner = {}\nset Cells = {}\n"
                               "set Density = {}\nset Young's modulus = 1e8\n"
                               "set Poisson's ratio = .3\nset Initial velocity = {}; 0{}\n",
                               corner(left, .005),
                               upper_corner(left + .35, .255),
                               plane_or_space<dim>("5, 4", "3, 2, 3"),
                               density,
                               speed,
                               plane_or_space<dim>("", "; 0")))) +
      section("Effects",
              section("contact", "set Activation distance = .005") +
                section("gravity",
                        plane_or_space<dim>("set Acceleration = 0, -9.81",
                                            "set Acceleration = 0, -9.81, 0")) +
                effects));
  }


  /// Once the block lies, the fluid has about the energy that it has as a body of that speed
  /// passes: none of the fall that the floor keeps the block from.
  template <int dim>
  void
  check_fluid(const double       density,
              const double       dt,
              const double       left,
              const std::string &effects = "")
  {
    INFO(dim << "D, " << density << " kg/m^3, steps of " << dt << ", from " << left << effects);
    auto         run   = block_on_the_floor<dim>(density, dt, left, effects);
    const double start = run.column("Fluid kinetic energy");
    while (run.state.clock.time < 1.5)
      {
        run.step();
        CHECK(run.column("energy closure") < 1e-8);
        CHECK(run.column("momentum closure") < 1e-8);
        if (run.state.clock.time > .5)
          {
            CHECK(run.column("Fluid kinetic energy") < 2 * start);
            CHECK(run.column("nodes in contact") > 0);
          }
      }
    CHECK(run.column("max speed block") < 1.05 * speed);
  }
} // namespace


TEST_CASE("a heavy block that slides over the floor does not stir the fluid", "[contact]")
{
  for (const double left : {.2, 3. / 14})
    check_fluid<2>(1e5, 1. / 15, left);
  check_fluid<2>(1e5, 1. / 30, .2);
  check_fluid<2>(1e4, 1. / 30, .2);
  check_fluid<3>(1e5, 1. / 30, .2);
  check_fluid<2>(1e5,
                 1. / 30,
                 .2,
                 section("viscosity", "set Dynamic viscosity = 1e-3") + section("convection", ""));
}
