// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <catch2/catch.hpp>
#include <effects/flow_run.h>

using namespace undine_tests;

namespace
{
  const std::string weight = section("gravity", "set Acceleration = 0, -10");

  std::string
  heat(const std::string &keys)
  {
    return section("scalar transport", section("heat", keys));
  }


  /// What `columns` says about the integral of the heat.
  double
  total_heat(const FlowRun<2> &run)
  {
    for (const auto &effect : run.effects)
      for (const auto &column : effect->columns(run.model, run.state, run.time))
        if (column.name == "Integral of heat")
          return column.value;
    return std::nan("");
  }
} // namespace


TEST_CASE("a source fills still fluid at its rate", "[scalars][mpi]")
{
  FlowRun<2> run(FluidText{"8, 6"}, heat("set Initial value = x\nset Source = 2*t"));
  run.run(10, 0.1);
  CHECK(total_heat(run) == Approx(0.5 + 1));
}


TEST_CASE("inflow brings its value in, and it leaves through the outflow", "[scalars][mpi]")
{
  for (const std::string diffusivity : {"0", "0.01"})
    {
      FlowRun<2> run(FluidText{"16, 4",
                               boundary("in", "left", "inflow", "set Velocity = 1; 0") +
                                 boundary("out", "right", "outflow"),
                               "1; 0"},
                     heat("set Inflow value = 3\nset Diffusivity = " + diffusivity));
      run.run(30, 0.1);
      CHECK(largest_error(run.state.scalars.at("heat"), [](const auto &) { return 3.; }) < 1e-6);
    }
}


TEST_CASE("Dirichlet walls conduct heat linearly through still fluid", "[scalars][mpi]")
{
  FlowRun<2> run(
    FluidText{"9, 5",
              boundary("hot", "left", "slip wall") + boundary("cold", "right", "slip wall"),
              "",
              "set Grading x = x^1.3"},
    heat("set Diffusivity = 1\nset Dirichlet boundaries = hot, cold\nset Dirichlet value = 5-3*x"));
  run.run(40, 1);
  CHECK(largest_error(run.state.scalars.at("heat"),
                      [](const auto &place) { return 5 - 3 * place[0]; }) < 1e-9);
}


TEST_CASE("stable layers stay at rest, the pressure carries them", "[scalars][mpi]")
{
  FlowRun<2> run(
    FluidText{"10, 12", "", "", "set Grading y = x^1.2", 2.},
    weight + convection() + viscosity(0.1) + heat("set Initial value = y^2") +
      section("buoyancy",
              section("heat", "set Expansion coefficient = 0.1\nset Reference value = 0.5")));
  run.run(5, 0.1);
  CHECK(largest_speed(run.model, run.state.velocity) < 1e-9);
  // dp/dy = rho beta (s - s0) |g|
  const auto &p = run.state.pressure;
  const auto &y = run.model.grid().cells()->row(1);
  for_each(p.owned(), [&](const GridIndex<2> &cell) {
    if (cell[1] + 1 < p.owned().upper[1])
      {
        const auto   above = moved<2>(cell, 1, 1);
        const double mean =
          (std::pow(y.position(cell[1]), 2) * run.model.grid().cell_width(1, above[1]) +
           std::pow(y.position(above[1]), 2) * run.model.grid().cell_width(1, cell[1])) /
          (run.model.grid().cell_width(1, above[1]) + run.model.grid().cell_width(1, cell[1]));
        REQUIRE((p(above) - p(cell)) / (y.position(above[1]) - y.position(cell[1])) ==
                Approx(2 * 0.1 * (mean - 0.5) * 10).margin(1e-6));
      }
  });
}


TEST_CASE("light fluid below rises, with the acceleration of the Boussinesq force",
          "[scalars][mpi]")
{
  // Uniformly light fluid between a pressure above and below: dv/dt = beta (s - s0) |g|.
  FlowRun<2> run(
    FluidText{"4, 6", boundary("open", "bottom, top", "pressure", "set Pressure = 0"), "", "", 3.},
    weight + convection() + heat("set Initial value = 2\nset Inflow value = 2") +
      section("buoyancy",
              section("heat", "set Expansion coefficient = 0.05\nset Reference value = 1")));
  run.run(10, 0.02);
  CHECK(largest_error(run.state.velocity[1], [](const auto &) { return 0.05 * 10 * 0.2; }) < 1e-9);
}


TEST_CASE("heated and cooled walls drive a circulation", "[scalars]")
{
  // Rayleigh number 1000 in the square: Nu = 1.118 (de Vahl Davis 1983).
  const std::string form = GENERATE("along paths", "flux");
  INFO(form);
  const double rayleigh = 1000, prandtl = 0.71;
  FlowRun<2>   run(
    FluidText{"24, 24",
              boundary("hot", "left", "no-slip wall") + boundary("cold", "right", "no-slip wall") +
                boundary("floor", "bottom, top", "no-slip wall")},
    section("gravity", "set Acceleration = 0, -1") + convection() + viscosity(prandtl) +
      section("scalar transport",
              "set Form = " + form + "\n" +
                section("heat",
                        "set Diffusivity = 1\nset Dirichlet boundaries = hot, cold\n"
                          "set Dirichlet value = 1-x\nset Initial value = 1-x")) +
      section("buoyancy",
              section("heat",
                      fmt::format("set Expansion coefficient = {}\nset Reference value = 0.5",
                                  rayleigh * prandtl))));
  run.run(150, 0.005);
  const auto &temperature = run.state.scalars.at("heat");
  double      nusselt     = 0;
  for (int j = 0; j < 24; ++j)
    nusselt += (1 - temperature(GridIndex<2>{{0, j}})) * 48 / 24;
  CHECK(nusselt == Approx(1.118).epsilon(0.01));
  // Heat that comes in on the left leaves on the right.
  double leaving = 0;
  for (int j = 0; j < 24; ++j)
    leaving += temperature(GridIndex<2>{{23, j}}) * 48 / 24;
  CHECK(leaving == Approx(nusselt).epsilon(0.005));
}


TEST_CASE("where no smoke is within reach none is advected, which changes nothing",
          "[scalars][mpi]")
{
  const std::string blob = "set Initial value = 3 + max(0, 1 - 60*((x-.3)^2 + (y-.4)^2))\n";
  for (const std::string method : {"semi-Lagrangian", "MacCormack", "cubic"})
    {
      const auto smoke = [&](const std::string &neglected) {
        FlowRun<2> run(
          FluidText{"32, 24",
                    boundary("in", "left", "inflow", "set Velocity = 1; 0") +
                      boundary("out", "right", "outflow"),
                    "1; 0"},
          section("scalar transport",
                  "set Method = " + method + "\n" +
                    section("smoke", blob + "set Neglected variation = " + neglected)));
        run.run(10, .03);
        return run.state.scalars.at("smoke");
      };
      const auto everywhere = smoke("0");
      for (const double share : {1e-3, 1e-6})
        {
          const auto where_it_is = smoke(fmt::format("{}", share));
          double     error = 0, untouched = 0;
          for_each(everywhere.owned(), [&](const GridIndex<2> &cell) {
            error = std::max(error, std::abs(where_it_is(cell) - everywhere(cell)));
            untouched += where_it_is(cell) == 3;
          });
          error     = dealii::Utilities::MPI::max(error, MPI_COMM_WORLD);
          untouched = dealii::Utilities::MPI::sum(untouched, MPI_COMM_WORLD);
          INFO(fmt::format("{} {}: {:.2e} {}", method, share, error, untouched));
          CHECK(error <= 10 * share);
          CHECK(untouched > 32 * 24 / 5);
        }
    }
}


TEST_CASE("a source that does not change is found once, one that does in every step",
          "[scalars][mpi]")
{
  for (const std::string factor : {"1", "(1+0*t)", "2*t/.5"})
    {
      FlowRun<2> run(FluidText{"8, 6"}, heat("set Source = if(x < .5, 2, 0)*" + factor));
      run.run(5, 0.1);
      CHECK(total_heat(run) == Approx(.5));
    }
}
