// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <coupled/coupled_run.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  /// A uniform stream along x, with the speed 1 m/s, that brings smoke in.
  template <int dim>
  std::string
  stream(const double       dt,
         const std::string &cells,
         const std::string &form,
         const std::string &smoke)
  {
    const std::string right = plane_or_space<dim>("1; 0", "1; 0; 0");
    return steps_of(dt) + section("Domain", "set Cells = " + cells) +
           section("Fluid",
                   "set Density = 1\nset Initial velocity = " + right + "\n" +
                     section("Boundaries",
                             boundary("in", "left", "inflow", "set Velocity = " + right) +
                               boundary("out", "right", "outflow"))) +
           section(
             "Effects",
             section("scalar transport", "set Form = " + form + "\n" + section("smoke", smoke)));
  }


  /// The largest error of smoke after 2 s; along paths away from the outflow, which fields leave
  /// with their last value.
  template <int dim, class Exact>
  double
  error_with(const std::string &text, const double dt, const double end, const Exact &exact)
  {
    CoupledRun<dim> run(text);
    for (int n = 0; n < std::lround(2 / dt); ++n)
      run.step();
    const auto &smoke = run.state.fluid.scalars.at("smoke");
    return largest_over(smoke.lattice(), [&](const GridIndex<dim> &cell) {
      const double x = smoke.lattice().point(cell)[0];
      return x < end ? std::abs(smoke(cell) - exact(x)) : 0.;
    });
  }


  template <int dim>
  void
  check_swinging(const std::string &form)
  {
    double last = 0;
    for (const double dt : {.1, .05})
      {
        const double now =
          error_with<dim>(stream<dim>(dt,
                                      plane_or_space<dim>("80, 2", "80, 2, 2"),
                                      form,
                                      "set Initial value = -sin(4*x)\nset Inflow value = sin(4*t)"),
                          dt,
                          form == "flux" ? 1 : .7,
                          [](const double x) { return std::sin(4 * (2 - x)); });
        INFO(fmt::format("{}D, {}, {} s: {:.3e} after {:.3e}", dim, form, dt, now, last));
        CHECK(now < (form == "flux" ? .7 * dt * dt : 1e-5));
        last = now;
      }
  }


  /// In steps that are shorter and longer than a cell takes, s = x stays as it is; along paths but
  /// for what is limited at the inflow and comes from the outflow.
  template <int dim>
  void
  check_source(const std::string &form)
  {
    for (const double dt : {.02, .1, .4})
      {
        const double error = error_with<dim>(stream<dim>(dt,
                                                         plane_or_space<dim>("16, 2", "16, 2, 2"),
                                                         form,
                                                         "set Initial value = x\nset Source = 1"),
                                             dt,
                                             form == "flux" ? 1 : .7,
                                             [](const double x) { return x; });
        INFO(fmt::format("{}D, {}, {} s: {:.3e}", dim, form, dt, error));
        CHECK(error < (form == "flux" ? 1e-12 : 1e-4));
      }
  }


  /// Towards a wall, from which it flows aside, s = y grows as y e^t.
  template <int dim>
  double
  error_beside_wall(const unsigned int cells)
  {
    const std::string flow = plane_or_space<dim>("x; -y", "x; -y; 0");
    CoupledRun<dim>   run(
      steps_of(.01) +
      section("Domain", fmt::format("set Cells = 8, {}{}", cells, plane_or_space<dim>("", ", 2"))) +
      section("Fluid",
              "set Density = 1\nset Initial velocity = " + flow + "\n" +
                section("Boundaries",
                        boundary("around", "right, top", "inflow", "set Velocity = " + flow))) +
      section("Effects",
              section("scalar transport",
                      "set Form = flux\n" +
                        section("smoke", "set Initial value = y\nset Inflow value = y*exp(t)"))));
    for (int n = 0; n < 100; ++n)
      run.step();
    const auto &smoke = run.state.fluid.scalars.at("smoke");
    return largest_over(smoke.lattice(), [&](const GridIndex<dim> &cell) {
      const double exact = smoke.lattice().point(cell)[1] * std::exp(1);
      return std::abs(smoke(cell) / exact - 1);
    });
  }


  template <int dim>
  void
  check_hold()
  {
    for (const double mu : {.1, 10.})
      {
        CoupledRun<dim> run(
          steps_of(.1) +
          section("Domain", "set Cells = " + plane_or_space<dim>("9, 8", "7, 6, 5")) +
          section("Fluid",
                  "set Density = 1\n" +
                    section("Boundaries", boundary("walls", every_side<dim>(), "no-slip wall"))) +
          section("Effects",
                  section("body force",
                          section("Fluid",
                                  "set Acceleration = " + plane_or_space<dim>("3; 4", "3; 4; 5"))) +
                    viscosity(mu)));
        for (int n = 0; n < 3; ++n)
          {
            run.step();
            INFO(fmt::format("{}D, {} Pa s, step {}", dim, mu, n));
            // Solved once, 8 % of what the force alone would bring.
            CHECK(run.column("Fluid largest speed") <= .01 * .1 * std::sqrt(dim == 2 ? 25. : 50.));
          }
      }
  }


  /// The same at all openings, which is no force.
  template <int dim>
  void
  check_growing_pressure()
  {
    CoupledRun<dim> run(
      steps_of(.1) + section("Domain", "set Cells = " + plane_or_space<dim>("9, 8", "7, 6, 5")) +
      section(
        "Fluid",
        "set Density = 1\n" +
          section("Boundaries",
                  boundary("open", "left, right", "pressure", "set Pressure = 50*t + 90*t^2") +
                    boundary("walls",
                             plane_or_space<dim>("bottom, top", "bottom, top, back, front"),
                             "no-slip wall"))) +
      section("Effects", viscosity(1)));
    for (int n = 0; n < 4; ++n)
      {
        run.step();
        INFO(fmt::format("{}D, step {}", dim, n));
        CHECK(run.column("Fluid largest speed") < 1e-8);
      }
  }
} // namespace


TEST_CASE("Fluid that enters brings what the inflow has had when it came", "[coupled][mpi]")
{
  for (const std::string form : {"along paths", "flux"})
    {
      check_swinging<2>(form);
      check_swinging<3>(form);
    }
}


TEST_CASE("Fluid that enters gains from sources for as long as it has been inside",
          "[coupled][mpi]")
{
  for (const std::string form : {"along paths", "flux"})
    {
      check_source<2>(form);
      check_source<3>(form);
    }
}


TEST_CASE("What does not diffuse keeps its slope up to walls that the flow comes towards",
          "[coupled][mpi]")
{
  CHECK(error_beside_wall<2>(10) < 1e-3);
  CHECK(error_beside_wall<2>(20) < 1e-3);
  CHECK(error_beside_wall<3>(10) < 1e-3);
}


TEST_CASE("A force that pressure holds hardly moves viscous fluid, from the first step on",
          "[coupled][mpi]")
{
  check_hold<2>();
  check_hold<3>();
}


TEST_CASE("A pressure that grows at all openings moves no viscous fluid", "[coupled][mpi]")
{
  check_growing_pressure<2>();
  check_growing_pressure<3>();
}
