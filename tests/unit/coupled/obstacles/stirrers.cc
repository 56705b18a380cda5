// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// A box turns in a box of fluid, with an opening or none.
  template <int dim>
  CoupledRun<dim>
  stirrer(const std::string &integrator,
          const double       dt,
          const bool         is_open,
          const std::string &bodies = "",
          const std::string &flux   = "")
  {
    return CoupledRun<dim>(
      section("Time", fmt::format("set Step = {}\nset Integrator = {}", dt, integrator)) + flux +
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
                                    "sin(3*t)*(x-0.35) + (cos(3*t)-1)*(y-0.5); 0"))) +
      bodies);
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


  /// A soft body beside it in a closed box is moved, but has no other volume than before, up to
  /// `tolerance`: in the plane linear elements have the faces of the surface.
  template <int dim>
  void
  check_stirred_body(const std::string &integrator,
                     const double       dt,
                     const double       tolerance,
                     const std::string &flux = "")
  {
    INFO(dim << "D, " << integrator << ", steps of " << dt);
    auto run = stirrer<dim>(
      integrator,
      dt,
      false,
      section("Bodies",
              body("soft",
                   plane_or_space<dim>("set Lower corner = .71, .33\nset Upper corner = .88, .64\n"
                                       "set Cells = 2, 4",
                                       "set Lower corner = .71, .33, .36\nset Upper corner = .88, "
                                       ".64, .67\nset Cells = 2, 4, 4") +
                     "\nset Density = 800\nset Young's modulus = 1e4\n"
                     "set Poisson's ratio = .4")) +
        section("Solid numerics", "set Element degree = 1"),
      flux);
    const double volume = run.column("volume soft");
    for (unsigned int n = 0; n < 4; ++n)
      {
        run.step();
        CHECK(run.column("max speed soft") > 1e-4);
        CHECK(run.column("volume soft") == Approx(volume).epsilon(tolerance));
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


TEST_CASE("A stirrer beside a body in a closed box does not press it", "[coupled][mpi]")
{
  for (const double dt : {.05, .005})
    {
      check_stirred_body<2>("trapezoid_bdf2", dt, 1e-10);
      // By the volume that surfaces sweep, as where steps are taken by implicit Euler.
      check_stirred_body<2>("theta", dt, 1e-10, section("Coupling", "set Boundary flux = swept"));
    }
  check_stirred_body<3>("trapezoid_bdf2", .05, 1e-3);
}
