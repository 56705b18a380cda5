// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <catch2/catch.hpp>
#include <effects/flow_run.h>
#include <iostream>
#include <chrono>

using namespace undine_tests;

namespace
{
  std::string
  by_fluxes(const std::string &keys)
  {
    return section("scalar transport", "set Form = flux\n" + section("smoke", keys));
  }


  /// A periodic box of cells of different widths, in which the flow turns and passes.
  template <int dim>
  FluidText
  periodic_box()
  {
    return {dim == 2 ? "24, 20" : "10, 9, 8",
            boundary("around", every_side<dim>(), "periodic"),
            dim == 2 ? "1+sin(2*pi*x)*cos(2*pi*y); .5+sin(4*pi*x)" :
                       "1+sin(2*pi*x)*cos(2*pi*y); sin(4*pi*x)+cos(2*pi*z); sin(2*pi*(x+y))",
            "set Grading x = x + 0.08*sin(2*pi*x)\nset Grading y = x - 0.07*sin(2*pi*x)"};
  }


  template <int dim>
  std::pair<double, double>
  range(const Field<dim> &values)
  {
    double least = std::numeric_limits<double>::max(), most = -least;
    for_each_value(values, [&](const double value, const auto &, const auto &) {
      least = std::min(least, value);
      most  = std::max(most, value);
    });
    return {dealii::Utilities::MPI::min(least, MPI_COMM_WORLD),
            dealii::Utilities::MPI::max(most, MPI_COMM_WORLD)};
  }


  template <int dim>
  const Field<dim> &
  smoke(const FlowRun<dim> &run)
  {
    return run.state.scalars.at("smoke");
  }


  /// The mean of |s - exact| over the domain.
  template <int dim, class Exact>
  double
  mean_error(const FlowRun<dim> &run, const Exact &exact)
  {
    auto difference = smoke(run);
    for_each_value(difference, [&](double &value, const auto &place, const auto &) {
      value = std::abs(value - exact(place));
    });
    return integral(run.model, difference);
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("Fluxes conserve a scalar and keep it in its bounds, whatever the step",
                       "[scalars][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const double cells : {.5, 2., 10.})
    {
      FlowRun<dim> run(periodic_box<dim>(),
                       by_fluxes("set Initial value = if((x-.4)^2 + (y-.5)^2 < .06, 3, 1)"));
      const double dt    = cells / (dim == 2 ? 24 : 10) / 2;
      const double start = integral(run.model, smoke(run));
      for (unsigned int n = 0; n < 8; ++n)
        {
          run.step(dt);
          const auto [least, most] = range(smoke(run));
          INFO(fmt::format("{} cells: {:.3e} {:.3e} {:.3e}", cells, integral(run.model, smoke(run)) / start - 1, 1 - least, most - 3));
          CHECK(std::abs(integral(run.model, smoke(run)) - start) <= 1e-12 * start);
          CHECK(least >= 1 - 1e-11);
          CHECK(most <= 3 + 1e-11);
        }
      std::cout << cells << ' ' << integral(run.model, smoke(run)) / start - 1 << ' ' << 1 - range(smoke(run)).first << ' ' << range(smoke(run)).second - 3 << ' ' << run.time << '\n';
    }
}


TEST_CASE("A smooth profile that turns is of second order by fluxes", "[scalars]")
{
  double last = 0;
  for (const int n : {32, 64, 128})
  {
    const std::string rate = "2*pi*if((x-.5)^2+(y-.5)^2 < .36^2, 1, if((x-.5)^2+(y-.5)^2 < .48^2, cos(pi/2*(sqrt((x-.5)^2+(y-.5)^2)-.36)/.12)^2, 0))";
    const std::string turning = rate + "*(.5-y);" + rate + "*(x-.5)";
    FlowRun<2> run(FluidText{fmt::format("{0}, {0}", n), boundary("around", every_side<2>(), "periodic"), turning},
                   by_fluxes("set Initial value = if((x-.5)^2+(y-.7)^2<.04, (1+cos(pi*sqrt((x-.5)^2+(y-.7)^2)/.2))^2/4, 0)\nset Inflow value = 0"));
    const auto start = smoke(run);
    run.run(4 * n, .25 / n);
    auto difference = smoke(run);
    add(difference, -1., start);
    for_each_value(difference, [&](double &value, const auto &, const auto &) { value = std::abs(value); });
    const double error = integral(run.model, difference) / integral(run.model, start);
    std::cout << "rotation " << n << ' ' << error << ' ' << std::log2(last / error) << ' ' << range(smoke(run)).second << ' ' << range(start).second<< '\n';
    last = error;
  }
  for (const double cfl : {.5, 2., 5.})
  for (const int n : {16, 32, 64, 128})
  {
    FlowRun<2> run(FluidText{fmt::format("{0}, {0}", n), boundary("around", every_side<2>(), "periodic"), "1; .5"},
                   by_fluxes("set Initial value = sin(2*pi*x)*cos(2*pi*y)"));
    const double dt = cfl / n;
    run.run(std::lround(.5 / dt), dt);
    const double error = mean_error(run, [&](const auto &p) { return std::sin(2 * M_PI * (p[0] - .5)) * std::cos(2 * M_PI * (p[1] - .25)); });
    std::cout << "translation " << cfl << ' ' << n << ' ' << error << ' ' << std::log2(last / error) << ' ' << largest_error(smoke(run), [&](const auto &p) { return std::sin(2 * M_PI * (p[0] - .5)) * std::cos(2 * M_PI * (p[1] - .25)); }) << '\n';
    last = error;
  }
}


TEST_CASE("steps", "[scalars]")
{
  for (const int n : {64, 128})
  for (const int per : {1, 4, 16})
  {
    const std::string rate = "2*pi*if((x-.5)^2+(y-.5)^2 < .36^2, 1, if((x-.5)^2+(y-.5)^2 < .48^2, cos(pi/2*(sqrt((x-.5)^2+(y-.5)^2)-.36)/.12)^2, 0))";
    const std::string turning = rate + "*(.5-y);" + rate + "*(x-.5)";
    FlowRun<2> run(FluidText{fmt::format("{0}, {0}", n), boundary("around", every_side<2>(), "periodic"), turning},
                   (getenv("PATHS") ? section("scalar transport", "set Form = along paths\n" + section("smoke", "set Initial value = if((x-.5)^2+(y-.7)^2<.04, (1+cos(pi*sqrt((x-.5)^2+(y-.7)^2)/.2))^2/4, 0)\nset Inflow value = 0")) : by_fluxes("set Initial value = if((x-.5)^2+(y-.7)^2<.04, (1+cos(pi*sqrt((x-.5)^2+(y-.7)^2)/.2))^2/4, 0)\nset Inflow value = 0")));
    const auto start = smoke(run);
    const auto begin = std::chrono::steady_clock::now();
    run.run(4 * n / per, .25 * per / n);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    auto difference = smoke(run);
    add(difference, -1., start);
    for_each_value(difference, [&](double &value, const auto &, const auto &) { value = std::abs(value); });
    const double error = integral(run.model, difference) / integral(run.model, start);
    std::cout << "rotation " << n << " CFL " << .56 * per << ": error " << error << " peak " << range(smoke(run)).second / range(start).second<< " drift " << integral(run.model, smoke(run))/integral(run.model, start) - 1 << "  " << seconds << " s\n";
  }
}
