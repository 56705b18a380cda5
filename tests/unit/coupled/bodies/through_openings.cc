// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <algorithm>
#include <cmath>

using namespace undine_tests;

namespace
{
  constexpr double fluid_weight = 1000; // downwards [Pa/m]


  /// Fluid in a box of 1 m, open on one side, whose reduced pressure there is `level` [Pa].
  template <int dim>
  std::string
  box(const std::string &side, const double level)
  {
    return section("Domain", plane_or_space<dim>("set Cells = 12, 13", "set Cells = 6, 7, 6")) +
           section(
             "Fluid",
             "set Density = 100\n" +
               section(
                 "Boundaries",
                 boundary("open", side, "pressure", fmt::format("set Pressure = {}", level)))) +
           section("Effects",
                   section("gravity",
                           plane_or_space<dim>("set Acceleration = 0, -10",
                                               "set Acceleration = 0, -10, 0")));
  }


  /// The force on a block that stands still and reaches out through a side. It is cut by the side
  /// or flush with it.
  template <int dim>
  dealii::Tensor<1, dim>
  force_at_rest(const std::string        &side,
                const double              level,
                const dealii::Point<dim> &lower,
                const dealii::Point<dim> &upper)
  {
    std::string from, to;
    for (unsigned int d = 0; d < dim; ++d)
      {
        from += fmt::format("{}{:.17g}", d == 0 ? "" : ", ", lower[d]);
        to += fmt::format("{}{:.17g}", d == 0 ? "" : ", ", upper[d]);
      }
    CoupledRun<dim> run(
      steps_of(.01) + box<dim>(side, level) +
      section(
        "Obstacles",
        obstacle("block", "box", "set Lower corner = " + from + "\nset Upper corner = " + to)));
    run.step();
    dealii::Tensor<1, dim> force;
    for (unsigned int d = 0; d < dim; ++d)
      force[d] = run.column(std::string("pressure force block ") + "xyz"[d]);
    return force;
  }


  /// The way that the centre of a free block takes in ten steps.
  template <int dim>
  dealii::Tensor<1, dim>
  way(const std::string &side, const double level, const std::string &block)
  {
    CoupledRun<dim> run(steps_of(1. / 60) + box<dim>(side, level) +
                        section("Solid numerics", "set Element degree = 1") +
                        section("Bodies",
                                body("block",
                                     block + "set Density = 50\nset Young's modulus = 1e7\n"
                                             "set Poisson's ratio = .3")));
    const auto      centre = [&] {
      dealii::Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = run.column(std::string("centre of mass block ") + "xyz"[d]);
      return result;
    };
    const auto first = centre();
    for (unsigned int n = 0; n < 10; ++n)
      run.step();
    return centre() - first;
  }
} // namespace


TEST_CASE("Bodies that reach out through an opening have the weight of the fluid in their place",
          "[coupled]")
{
  const dealii::Point<2> lower(.31, .6);
  for (const double level : {0., 1e3, -2e4})
    for (const double top : {.9, .99999, 1., 1.00001, 1.1, 1.4})
      {
        INFO("level " << level << " Pa, top " << top);
        // Out of the top: as far as they are in the fluid. Outside the pressure is the same all
        // over.
        const auto up = force_at_rest<2>("top", level, lower, {.64, top});
        CHECK(std::abs(up[0]) < 1e-6 * (1e3 + std::abs(level)));
        CHECK(up[1] == Approx(fluid_weight * .33 * (std::min(top, 1.) - .6)).epsilon(1e-4));
        // Out of a side: all of it, for outside the fluid is at rest, too.
        const auto aside = force_at_rest<2>("right", level, {.6, .31}, {top, .64});
        CHECK(std::abs(aside[0]) < 1e-4 * (1e3 + std::abs(level)));
        CHECK(aside[1] == Approx(fluid_weight * .33 * (top - .6)).epsilon(1e-4));
      }
  const auto up = force_at_rest<3>("top", 3e3, {.31, .6, .2}, {.64, 1.2, .71});
  CHECK(up[1] == Approx(fluid_weight * .33 * .51 * .4).epsilon(1e-4));
  CHECK(std::abs(up[0]) + std::abs(up[2]) < .1);
}


TEST_CASE("The level of the pressure does not move bodies that pass an opening", "[coupled]")
{
  const std::string floating = "set Lower corner = .3, .62\nset Upper corner = .6, 1.02\n"
                               "set Cells = 3, 4\n";
  const std::string leaving  = "set Lower corner = .62, .3\nset Upper corner = 1.02, .6\n"
                               "set Cells = 4, 3\nset Initial velocity = 1; 0\n";
  const auto        up       = way<2>("top", fluid_weight, floating);
  CHECK(up[1] > .01); // from .4 m, of which half is in the fluid at rest
  for (const double level : {0., 3000.})
    CHECK((way<2>("top", level, floating) - up).norm() < 1e-3 * up.norm());
  const auto aside = way<2>("right", fluid_weight, leaving);
  for (const double level : {0., 3000.})
    CHECK((way<2>("right", level, leaving) - aside).norm() < 1e-3 * aside.norm());
  const std::string in_space = "set Lower corner = .3, .62, .3\nset Upper corner = .6, 1.02, .7\n"
                               "set Cells = 2, 2, 2\n";
  const auto        rising   = way<3>("top", fluid_weight, in_space);
  CHECK((way<3>("top", 0, in_space) - rising).norm() < 1e-3 * rising.norm());
}
