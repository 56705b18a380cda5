// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/model/fluid_quantities.h>

#include <coupled/obstacle_run.h>
#include <effects/scalar_samples.h>

using namespace undine_tests;

namespace
{
  template <int dim>
  const Field<dim> &
  smoke_among(const ObstacleRun<dim> &run)
  {
    return run.state.fluid.scalars.at("smoke");
  }


  template <int dim>
  double
  total(const ObstacleRun<dim> &run)
  {
    return integral(*run.models.fluid, smoke_among(run));
  }


  /// Over some steps: the integral of smoke changes by no more than rounding, and its values stay
  /// between 0 and 1.
  template <int dim>
  void
  check_laws(ObstacleRun<dim> &run, const unsigned int n_steps)
  {
    const double start = total(run);
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        run.step();
        REQUIRE(run.column("Flagged cells") == 0);
        const auto [least, most] = range_of(smoke_among(run));
        INFO(fmt::format("{:.2e} {:.2e} {:.2e}", total(run) / start - 1, least, most - 1));
        REQUIRE(std::abs(total(run) / start - 1) <= 1e-12);
        REQUIRE(least >= -1e-13);
        REQUIRE(most <= 1 + 1e-13);
      }
  }


  /// A closed box with a body that swings in it.
  template <int dim>
  ObstacleRun<dim>
  swinging(const double thickness, const double dt, const std::string &smoke)
  {
    return ObstacleRun<dim>(
      section("Domain", plane_or_space<dim>("set Cells = 20, 20", "set Cells = 9, 8, 8")) +
        section("Fluid", "set Density = 1"),
      obstacle("body",
               "box",
               fmt::format(plane_or_space<dim>(
                             "set Lower corner = .3, .25\nset Upper corner = {}, .75\n",
                             "set Lower corner = .3, .25, .25\nset Upper corner = {}, .75, .8\n"),
                           .3 + thickness) +
                 "set Displacement = .3*sin(6*t)^2; .1*sin(5*t)" + plane_or_space<dim>("", "; 0")),
      smoke_by_fluxes(smoke),
      dt);
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("Fluxes conserve a scalar and keep its bounds while bodies move",
                       "[coupled][scalars][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const double thickness : {.001, .21})
    for (const double dt : {.01, .05})
      {
        INFO(thickness << " thick, in steps of " << dt);
        auto run = swinging<dim>(thickness, dt, "set Initial value = if(x-.5*y < .3, 1, 0)");
        check_laws(run, 12);
      }
}


TEMPLATE_TEST_CASE_SIG("Fluxes conserve a scalar and keep its bounds in cells of any size",
                       "[coupled][scalars][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  // Cells of 1/10 of which the block leaves a thousandth and three thousandths.
  for (const double cells : {.5, 2., 10.})
    {
      INFO(cells << " cells in a step");
      const std::string right = plane_or_space<dim>("1; .3", "1; .3; -.2");
      ObstacleRun<dim>  run(
        section("Domain", plane_or_space<dim>("set Cells = 10, 10", "set Cells = 10, 10, 10")) +
          section("Fluid",
                  "set Density = 1\nset Initial velocity = " + right + "\n" +
                    section("Boundaries", boundary("around", every_side<dim>(), "periodic"))),
        obstacle("block",
                 "box",
                 plane_or_space<dim>(
                   "set Lower corner = .3001, .4003\nset Upper corner = .5999, .5997",
                   "set Lower corner = .3001, .4003, .3001\nset Upper corner = .5999, .5997, .7")),
        smoke_by_fluxes("set Initial value = if(x > .2 && x < .5, 1, 0)"),
        .1 * cells);
      check_laws(run, 8);
    }
}


TEMPLATE_TEST_CASE_SIG("A uniform scalar stays so by fluxes while bodies move",
                       "[coupled][scalars][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const double thickness : {1e-4, .21})
    {
      auto run = swinging<dim>(thickness, .02, "set Initial value = 1.7");
      for (unsigned int n = 0; n < 12; ++n)
        run.step();
      CHECK(largest_in_cells(smoke_among(run), [](const double value, const auto &) {
              return std::abs(value - 1.7);
            }) <= 1e-13);
    }
}


TEMPLATE_TEST_CASE_SIG("Nothing leaks by fluxes through a thin sheet that moves",
                       "[coupled][scalars][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  // It closes the box from wall to wall, and pushes the fluid there and back, by up to three cells
  // in a step.
  for (const double dt : {.01, .05, .15})
    {
      ObstacleRun<dim> run(
        section("Domain", plane_or_space<dim>("set Cells = 16, 10", "set Cells = 12, 6, 5")) +
          section("Fluid",
                  "set Density = 1\n" +
                    section("Boundaries", boundary("ends", "left, right", "outflow"))),
        obstacle(
          "sheet",
          "box",
          plane_or_space<dim>("set Lower corner = .3, -1\nset Upper corner = .3001, 2",
                              "set Lower corner = .3, -1, -1\nset Upper corner = .3001, 2, 2") +
            "\nset Displacement = .4*sin(3*t)" + plane_or_space<dim>("; 0", "; 0; 0")),
        smoke_by_fluxes("set Initial value = if(x < .30005, 1, 0)\n"
                        "set Inflow value = if(x < .5, 1, 0)"),
        dt);
      while (run.state.clock.time < .75)
        {
          // Where it is in the fluid's grid: at the begin of the step.
          const double at = .30005 + .4 * std::sin(3 * run.state.clock.time);
          run.step();
          REQUIRE(largest_in_cells(smoke_among(run), [&](const double value, const auto &place) {
                    return std::abs(value - (place[0] < at ? 1 : 0));
                  }) <= 1e-12);
        }
    }
}


TEST_CASE("Diffusion goes around a cylinder", "[coupled][scalars][mpi]")
{
  // x (1 + R^2/r^2) about its centre: harmonic, without flux through it.
  const double radius = .2, centre[] = {.503, .497};
  const auto   error = [&](const int n) {
    const std::string exact =
      fmt::format("(x-{0})*(1+{2}^2/((x-{0})^2+(y-{1})^2))", centre[0], centre[1], radius);
    ObstacleRun<2> run(
      section("Domain", fmt::format("set Cells = {0}, {0}", n)) +
        section("Fluid",
                "set Density = 1\n" +
                  section("Boundaries", boundary("around", every_side<2>(), "slip wall"))),
      obstacle("cylinder",
               "ball",
               fmt::format("set Centre = {}, {}\nset Radius = {}\nset Refinements = 5",
                           centre[0],
                           centre[1],
                           radius)),
      smoke_by_fluxes("set Diffusivity = 1\nset Dirichlet boundaries = around\n"
                        "set Dirichlet value = " +
                      exact),
      1.);
    for (unsigned int k = 0; k < 20; ++k)
      run.step();
    auto difference = smoke_among(run);
    for_each_value(difference, [&](double &value, const auto &place, const auto &) {
      const double x = place[0] - centre[0], y = place[1] - centre[1];
      value = std::abs(value - x * (1 + radius * radius / (x * x + y * y)));
    });
    return integral(*run.models.fluid, difference);
  };
  const double coarse = error(16), middle = error(32), fine = error(64);
  INFO(fmt::format("{:.3e} {:.3e} {:.3e}", coarse, middle, fine));
  CHECK(fine < 3e-5);
  CHECK(std::log2(coarse / middle) >= 1.6);
  CHECK(std::log2(middle / fine) >= 1.8);
}
