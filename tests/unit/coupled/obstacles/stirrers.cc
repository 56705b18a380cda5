// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// A box turns in a box of fluid, with an opening or none.
  template <int dim>
  CoupledRun<dim>
  stirrer(const std::string &integrator, const double dt, const bool is_open)
  {
    return CoupledRun<dim>(
      section("Time", fmt::format("set Step = {}\nset Integrator = {}", dt, integrator)) +
      section("Domain",
              plane_or_space<dim>("set Cells = 24, 24",
                                  "set Lower corner = 0, 0, 0\nset Upper corner = 1, 1, 1\n"
                                  "set Cells = 12, 12, 6")) +
      section("Fluid",
              "set Density = 1000" +
                (is_open ? "\n" + section("Boundaries",
                                          section("gap", "set Sides = top\nset Kind = outflow"))
                         : std::string())) +
      section(
        "Obstacles",
        section("stirrer",
                plane_or_space<dim>("set Centre = 0.35, 0.5\nset Size = 0.4, 0.1\nset Displacement "
                                    "= (cos(3*t)-1)*(x-0.35) - sin(3*t)*(y-0.5); "
                                    "sin(3*t)*(x-0.35) + (cos(3*t)-1)*(y-0.5)",
                                    "set Centre = 0.35, 0.5, 0.5\nset Size = 0.4, 0.2, 0.3\nset "
                                    "Displacement = (cos(3*t)-1)*(x-0.35) - sin(3*t)*(y-0.5); "
                                    "sin(3*t)*(x-0.35) + (cos(3*t)-1)*(y-0.5); 0"))));
  }


  /// What is rigid takes up no room by turning: a closed box has a flow, and through an opening
  /// nothing flows on balance.
  template <int dim>
  void
  check_stirrer(const std::string &integrator, const double dt)
  {
    for (const bool is_open : {false, true})
      {
        INFO(dim << "D, " << integrator << ", steps of " << dt << (is_open ? ", open" : ""));
        auto run = stirrer<dim>(integrator, dt, is_open);
        for (unsigned int n = 0; n < 4; ++n)
          {
            run.step();
            CHECK(run.column("Fluid kinetic energy") > 0);
            if (is_open)
              CHECK(std::abs(run.column("Flux through gap")) <= 1e-12);
          }
      }
  }
} // namespace


TEST_CASE("A stirrer displaces no fluid on balance, whatever the integrator", "[coupled][mpi]")
{
  for (const std::string &integrator : {"trapezoid_bdf2", "theta", "newmark"})
    for (const double dt : {.05, .005})
      check_stirrer<2>(integrator, dt);
  check_stirrer<3>("trapezoid_bdf2", .05);
}
