// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/model/fluid_quantities.h>

#include <coupled/obstacle_run.h>
#include <iostream>

using namespace undine_tests;

namespace
{
  std::string
  by_fluxes(const std::string &keys)
  {
    return section("scalar transport", "set Form = flux\n" + section("smoke", keys));
  }


  template <int dim>
  const Field<dim> &
  smoke(const ObstacleRun<dim> &run)
  {
    return run.state.fluid.scalars.at("smoke");
  }


  /// How far below 0 or above 1 the smoke is anywhere.
  template <int dim>
  double
  outside(const ObstacleRun<dim> &run)
  {
    return largest_in_cells(smoke(run), [](const double value, const auto &) {
      return std::max(-value, value - 1);
    });
  }


  /// A closed box with a body that swings in it.
  template <int dim>
  ObstacleRun<dim>
  swinging(const std::string &thickness, const double dt, const std::string &smoke)
  {
    const std::string box = fmt::format(
      plane_or_space<dim>("set Lower corner = .3, .25\nset Upper corner = .3+{0}, .75",
                          "set Lower corner = .3, .25, .25\nset Upper corner = .3+{0}, .75, .8"),
      thickness);
    return ObstacleRun<dim>(
      section("Domain", plane_or_space<dim>("set Cells = 20, 20", "set Cells = 9, 8, 8")) +
        section("Fluid", "set Density = 1"),
      obstacle("body", "box", box + "\nset Displacement = " + plane_or_space<dim>(".3*sin(6*t)^2; .1*sin(5*t)", ".3*sin(6*t)^2; .1*sin(5*t); 0")),
      by_fluxes(smoke),
      dt);
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("Bodies that move leave a scalar in closed fluid its integral and bounds",
                       "[coupled][scalars][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const std::string thickness : {".001", ".21"})
    for (const double dt : {.01, .05})
      {
        auto         run   = swinging<dim>(thickness, dt, "set Initial value = if(x-.5*y < .3, 1, 0)");
        const double start = integral(*run.models.fluid, smoke(run));
        double       drift = 0, excess = 0;
        for (unsigned int n = 0; n < 12; ++n)
          {
            run.step();
            drift  = std::max(drift, std::abs(integral(*run.models.fluid, smoke(run)) / start - 1));
            excess = std::max(excess, outside(run));
          }
        std::cout << dim << ' ' << thickness << ' ' << dt << ": drift " << drift << " excess " << excess << " flagged " << run.column("Flagged cells") << '\n';
        INFO(fmt::format("{} {}: {:.2e} {:.2e}", thickness, dt, drift, excess));
        CHECK(drift <= 1e-11);
        CHECK(excess <= 1e-11);
      }
}


TEMPLATE_TEST_CASE_SIG("A uniform scalar stays so by fluxes while bodies move",
                       "[coupled][scalars][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const std::string thickness : {"1e-4", ".21"})
    {
      auto run = swinging<dim>(thickness, .02, "set Initial value = 1.7");
      for (unsigned int n = 0; n < 12; ++n)
        run.step();
      const double error = largest_in_cells(
                  smoke(run), [](const double value, const auto &) { return std::abs(value - 1.7); });
      std::cout << "uniform " << error << '\n';
      CHECK(error <= 1e-11);
    }
}


TEMPLATE_TEST_CASE_SIG("Nothing leaks by fluxes through a thin sheet that moves",
                       "[coupled][scalars][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  // It closes the box from wall to wall; the fluid moves with it.
  for (const double dt : {.01, .05})
    {
      ObstacleRun<dim> run(
        section("Domain", plane_or_space<dim>("set Cells = 16, 10", "set Cells = 12, 6, 5")) +
          section("Fluid",
                  "set Density = 1\n" +
                    section("Boundaries", boundary("ends", "left, right", "outflow"))),
        obstacle("sheet",
                 "box",
                 plane_or_space<dim>("set Lower corner = .3, -1\nset Upper corner = .3001, 2",
                                     "set Lower corner = .3, -1, -1\nset Upper corner = .3001, 2, 2") +
                   "\nset Displacement = .4*sin(3*t)" + plane_or_space<dim>("; 0", "; 0; 0")),
        by_fluxes("set Initial value = if(x < .30005, 1, 0)\nset Inflow value = if(x < .5, 1, 0)"),
        dt);
      double leaked = 0;
      for (unsigned int n = 0; n < 16; ++n)
        {
          run.step();
          const double at = .30005 + .4 * std::sin(3 * (run.state.clock.time));
          const double at0 = .30005 + .4 * std::sin(3 * (run.state.clock.time - dt));
          leaked = std::max(leaked, std::min(largest_in_cells(smoke(run), [&](const double value, const auto &place) {
            return std::abs(value - (place[0] < at ? 1 : 0));
          }), largest_in_cells(smoke(run), [&](const double value, const auto &place) {
            return std::abs(value - (place[0] < at0 ? 1 : 0));
          })));
        }
      std::cout << "leak " << dt << ' ' << leaked << '\n';
      CHECK(leaked <= 1e-11);
    }
}


TEST_CASE("Diffusion goes around a cylinder", "[coupled][scalars][mpi]")
{
  // x (1 + a^2/r^2) about it: harmonic, without flux through it.
  const std::string exact = "(x-.503)*(1+.2^2/((x-.503)^2+(y-.497)^2))";
  double last = 0;
  for (const int n : {16, 32, 64})
    {
      ObstacleRun<2> run(section("Domain", fmt::format("set Cells = {0}, {0}", n)) + section("Fluid", "set Density = 1\n"
       + section("Boundaries", boundary("around", every_side<2>(), "slip wall"))),
        obstacle("cylinder", "ball", "set Centre = .503, .497\nset Radius = .2\nset Refinements = 5"),
        by_fluxes("set Diffusivity = 1\nset Dirichlet boundaries = around\nset Dirichlet value = " + exact), 1.);
      for (int k = 0; k < 40; ++k)
        run.step();
      auto difference = smoke(run);
      double worst = 0;
      for_each_value(difference, [&](double &value, const auto &p, const auto &) {
        const double x = p[0] - .503, y = p[1] - .497;
        value = std::abs(value - x * (1 + .04 / (x * x + y * y)));
        worst = std::max(worst, value);
      });
      const double error = integral(*run.models.fluid, difference);
      std::cout << "cylinder " << n << ' ' << error << ' ' << std::log2(last / error) << " largest " << worst << '\n';
      last = error;
    }
}
