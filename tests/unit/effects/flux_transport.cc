// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/model/fluid_quantities.h>

#include <catch2/catch.hpp>
#include <effects/scalar_samples.h>

using namespace undine_tests;

namespace
{

  /// A periodic box of cells of different widths, in which the flow turns and passes.
  template <int dim>
  FluidText
  graded_box()
  {
    return {dim == 2 ? "24, 20" : "10, 9, 8",
            boundary("around", every_side<dim>(), "periodic"),
            dim == 2 ? "1+sin(2*pi*x)*cos(2*pi*y); .5+sin(4*pi*x)"
                     : "1+sin(2*pi*x)*cos(2*pi*y); sin(4*pi*x)+cos(2*pi*z); sin(2*pi*(x+y))",
            "set Grading x = x + 0.08*sin(2*pi*x)\nset Grading y = x - 0.07*sin(2*pi*x)"};
  }


  template <int dim>
  const Field<dim> &
  smoke_of(const FlowRun<dim> &run)
  {
    return run.state.scalars.at("smoke");
  }


  /// The mean of |s - exact| over the domain.
  template <int dim, class Exact>
  double
  mean_error(const FlowRun<dim> &run, const Exact &exact)
  {
    auto difference = smoke_of(run);
    for_each_value(difference, [&](double &value, const auto &place, const auto &) {
      value = std::abs(value - exact(place));
    });
    return integral(run.model, difference);
  }


  /// Of errors on grids of n cells along each axis, `error(n)`, each of twice as many as the last.
  template <class Error>
  void
  check_second_order(const unsigned int coarsest, const Error &error)
  {
    double last = error(coarsest);
    for (const unsigned int n : {2 * coarsest, 4 * coarsest})
      {
        const double now = error(n);
        INFO(fmt::format("{} cells: {:.3e} after {:.3e}", n, now, last));
        CHECK(std::log2(last / now) >= 1.8);
        last = now;
      }
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("Fluxes conserve a scalar and keep it in its bounds, whatever the step",
                       "[scalars][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const double cells : {.5, 2., 10., 50.})
    {
      FlowRun<dim> run(graded_box<dim>(),
                       smoke_by_fluxes("set Initial value = if((x-.4)^2 + (y-.5)^2 < .06, 3, 1)"));
      const double dt    = cells / (dim == 2 ? 24 : 10) / 2;
      const double start = integral(run.model, smoke_of(run));
      for (unsigned int n = 0; n < 8; ++n)
        {
          run.step(dt);
          const auto [least, most] = range_of(smoke_of(run));
          const double drift       = integral(run.model, smoke_of(run)) / start - 1;
          INFO(fmt::format("{} cells: {:.2e} {:.2e} {:.2e}", cells, drift, 1 - least, most - 3));
          CHECK(std::abs(drift) <= 1e-12);
          CHECK(least >= 1 - 1e-13);
          CHECK(most <= 3 + 1e-13);
        }
    }
}


TEST_CASE("A wave that passes is of second order by fluxes, in steps of half a cell and of two",
          "[scalars]")
{
  for (const double cells : {.5, 2.})
    check_second_order(cells < 1 ? 16 : 32, [&](const unsigned int n) {
      FlowRun<2>   run(FluidText{fmt::format("{0}, {0}", n),
                               boundary("around", every_side<2>(), "periodic"),
                               "1; .5"},
                     smoke_by_fluxes("set Initial value = sin(2*pi*x)*cos(2*pi*y)"));
      const double dt = cells / n;
      run.run(std::lround(.25 / dt), dt);
      return mean_error(run, [](const auto &place) {
        return std::sin(2 * pi * (place[0] - .25)) * std::cos(2 * pi * (place[1] - .125));
      });
    });
}


TEST_CASE("Fluxes fill the cells that an inflow reaches in a step of several", "[scalars]")
{
  const int  n = 16;
  FlowRun<2> run(FluidText{fmt::format("{}, 4", n),
                           boundary("in", "left", "inflow", "set Velocity = 1; 0") +
                             boundary("out", "right", "outflow"),
                           "1; 0"},
                 smoke_by_fluxes("set Initial value = 0\nset Inflow value = 1"));
  run.step(4. / n);
  const auto in = [&](const int column) { return smoke_of(run)(GridIndex<2>{{column, 1}}); };
  for (int column = 0; column < 3; ++column)
    {
      INFO(column);
      CHECK(in(column) == Approx(1.).margin(1e-9));
    }
  CHECK(in(3) > .97);
  CHECK(in(4) < .02);
}


TEST_CASE("A wide cell gets what comes through narrow ones", "[scalars]")
{
  // Eight cells of .025, then of .1: in one step a wide one is filled by the last four narrow ones.
  FlowRun<2> run(FluidText{"16, 2",
                           boundary("in", "left", "inflow", "set Velocity = 1; 0") +
                             boundary("out", "right", "outflow"),
                           "1; 0",
                           "set Grading x = if(x < .5, .4*x, .2 + 1.6*(x-.5))"},
                 smoke_by_fluxes("set Initial value = if(x > .1 && x < .175, 1, 0)"));
  run.step(.1);
  CHECK(smoke_of(run)(GridIndex<2>{{8, 0}}) == Approx(.75).margin(.05));
}


TEST_CASE("Fluxes on a graded grid are alike turned by half", "[scalars]")
{
  // In steps of several of the finest cells: what comes to a face is the same from both sides.
  const int  n = 20;
  FlowRun<2> run(FluidText{fmt::format("{0}, {0}", n),
                           boundary("around", every_side<2>(), "slip wall"),
                           "sin(pi*x)*cos(pi*y); -cos(pi*x)*sin(pi*y)",
                           "set Grading x = x - .12*sin(2*pi*x)\nset Grading y = x - "
                           ".12*sin(2*pi*x)"},
                 smoke_by_fluxes("set Initial value = x"));
  run.run(4, .1);
  const auto &smoke   = smoke_of(run);
  double      largest = 0, change = 0;
  for_each(smoke.owned(), [&](const GridIndex<2> &cell) {
    const double other = smoke(GridIndex<2>{{n - 1 - cell[0], n - 1 - cell[1]}});
    largest            = std::max(largest, std::abs(smoke(cell) + other - 1));
    change             = std::max(change, std::abs(smoke(cell) - smoke.lattice().point(cell)[0]));
  });
  CHECK(change > .1);
  CHECK(largest <= 1e-12);
}


TEST_CASE("A smooth profile that turns is of second order by fluxes", "[scalars]")
{
  // The fluid turns like a solid to .36 from the centre, and is at rest farther than .48 from it.
  const std::string square = "((x-.5)^2+(y-.5)^2)";
  const std::string rate   = "2*pi*if(" + square + " < .36^2, 1, if(" + square +
                           " < .48^2, cos(pi/2*(sqrt(" + square + ")-.36)/.12)^2, 0))";
  check_second_order(32, [&](const unsigned int n) {
    FlowRun<2> run(FluidText{fmt::format("{0}, {0}", n),
                             boundary("around", every_side<2>(), "periodic"),
                             rate + "*(.5-y); " + rate + "*(x-.5)"},
                   smoke_by_fluxes("set Initial value = if((x-.6)^2+(y-.5)^2 < .25^2, "
                                   "cos(pi/2*sqrt((x-.6)^2+(y-.5)^2)/.25)^4, 0)"));
    run.run(n, .25 / n);
    return mean_error(run, [](const auto &place) {
      const double r = std::hypot(place[0] - .5, place[1] - .6);
      return r < .25 ? std::pow(std::cos(pi / 2 * r / .25), 4) : 0.;
    });
  });
}


TEMPLATE_TEST_CASE_SIG(
  "Fluxes bring in what enters, and no more", "[scalars][mpi]", ((int dim), dim), 2, 3)
{
  const std::string right = dim == 2 ? "1; 0" : "1; 0; 0";
  for (const double dt : {.01, .1})
    {
      FlowRun<dim> run(FluidText{dim == 2 ? "16, 4" : "12, 4, 3",
                                 boundary("in", "left", "inflow", "set Velocity = " + right) +
                                   boundary("out", "right", "outflow"),
                                 right},
                       smoke_by_fluxes("set Initial value = 1\nset Inflow value = 3\n"
                                       "set Source = if(x < .5, t, 0)"));
      // The last cells get some of it with any implicit step.
      const double end = .1;
      run.run(std::lround(end / dt), dt);
      CHECK(integral(run.model, smoke_of(run)) ==
            Approx(1 + 2 * end + end * end / 4).epsilon(1e-9));
      run.run(20, .2);
      CHECK(range_of(smoke_of(run)).first >= 3 - 1e-6);
    }
}


TEST_CASE("Fluxes conduct heat linearly between walls, and leave it at rest", "[scalars][mpi]")
{
  FlowRun<2> run(
    FluidText{"9, 5",
              boundary("hot", "left", "slip wall") + boundary("cold", "right", "slip wall"),
              "",
              "set Grading x = x^1.3"},
    smoke_by_fluxes("set Diffusivity = 1\nset Dirichlet boundaries = hot, cold\n"
                    "set Dirichlet value = 5-3*x"));
  const auto error = [&] {
    return largest_error(smoke_of(run), [](const auto &place) { return 5 - 3 * place[0]; });
  };
  run.run(40, 1);
  CHECK(error() < 1e-9);
  run.run(10, .01);
  CHECK(error() < 1e-9);
}
