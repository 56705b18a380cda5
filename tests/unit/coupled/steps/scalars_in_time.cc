// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <array>
#include <cmath>

using namespace undine_tests;

namespace
{
  /// Heat from a source that swings, in a box whose left wall swings in temperature, too.
  std::string
  heated_box(const double dt, const std::string &expansion, const std::string &form)
  {
    return steps_of(dt) + section("Time", "set Integrator = trapezoid_bdf2") +
           section("Domain", "set Cells = 16, 16") +
           section("Fluid",
                   "set Density = 1\n" +
                     section("Boundaries",
                             boundary("hot", "left", "slip wall") +
                               boundary("rest", "right, bottom", "slip wall"))) +
           section("Effects",
                   section("gravity", "set Acceleration = 0, -1") + convection() +
                     section("scalar transport",
                             "set Form = " + form + "\n" +
                               section("heat",
                                       "set Initial value = cos(pi*x)\n"
                                       "set Source = 9*sin(5*t)*cos(pi*x)*(1+cos(pi*y))\n"
                                       "set Diffusivity = .2\nset Dirichlet boundaries = hot\n"
                                       "set Dirichlet value = cos(4*t)")) +
                     section("buoyancy",
                             section("heat",
                                     "set Expansion coefficient = " + expansion +
                                       "\nset Reference value = 0")));
  }


  /// Heat, and the velocity that rises.
  std::array<Field<2>, 2>
  fields_after(const double dt, const std::string &expansion, const std::string &form)
  {
    CoupledRun<2> run(heated_box(dt, expansion, form));
    for (int n = 0; n < std::lround(.4 / dt); ++n)
      run.step();
    return {{run.state.fluid.scalars.at("heat"), run.state.fluid.velocity[1]}};
  }


  double
  difference(const Field<2> &a, const Field<2> &b)
  {
    double sum = 0;
    for_each(a.owned(),
             [&](const GridIndex<2> &index) { sum += std::pow(a(index) - b(index), 2); });
    return std::sqrt(dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD));
  }


  /// From three runs, each with half the step of the one before.
  void
  check_order(const std::string &expansion, const unsigned int n_fields, const std::string &form)
  {
    const double dt     = .04;
    const auto   coarse = fields_after(dt, expansion, form),
               middle   = fields_after(dt / 2, expansion, form),
               fine     = fields_after(dt / 4, expansion, form);
    for (unsigned int k = 0; k < n_fields; ++k)
      {
        const double first  = difference(coarse[k], middle[k]),
                     second = difference(middle[k], fine[k]);
        INFO(fmt::format("{}, field {}: {:.3e} {:.3e}", form, k, first, second));
        CHECK(std::log2(first / second) >= 1.8);
        CHECK(second > 1e-9);
      }
  }
} // namespace


TEST_CASE("Heat from sources and walls is of second order in time by TR-BDF2", "[coupled][mpi]")
{
  for (const std::string form : {"along paths", "flux"})
    {
      SECTION("in still fluid, " + form)
      {
        check_order("1e-12", 1, form);
      }
      SECTION("in fluid that it sets in motion, and that motion too, " + form)
      {
        check_order("2", 2, form);
      }
    }
}
