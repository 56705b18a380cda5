// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/convection/short_waves.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <catch2/catch.hpp>
#include <coupled/coupled_run.h>
#include <effects/flow_run.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  /// `velocity` after a step of `dt`, in a flow that is the same, but for a uniform `stream` on top
  /// of its first component.
  template <int dim>
  Velocity<dim>
  damped(const FluidModel<dim> &model,
         const Velocity<dim>   &velocity,
         const double           dt,
         const double           stream = 0)
  {
    auto flow = velocity;
    for_each(flow[0].owned(), [&](const GridIndex<dim> &face) { flow[0](face) += stream; });
    exchange(flow);
    auto result = velocity;
    damp_short_waves(model, flow, dt, result);
    return result;
  }


  /// Of a wave in the second component that a stream of 3 m/s carries along x, through a periodic
  /// box of 24 cells: what is left of it after 0.01 s [1].
  double
  left_of_wave(const unsigned int n_waves)
  {
    const auto model  = make_model<2>(FluidText{
      "24, 5", boundary("around", every_side<2>(), "periodic"), "", "set Upper corner = 6, 1"});
    auto       state  = model.initial_state();
    const auto places = model.grid().faces(1);
    for_each(places->owned(), [&](const GridIndex<2> &face) {
      state.velocity[1](face) = std::cos(2 * pi * n_waves * places->point(face)[0] / 6 + 0.1);
    });
    const auto after = damped(model, state.velocity, 0.01, 3.);
    return inner_product(model, after, state.velocity) /
           inner_product(model, state.velocity, state.velocity);
  }
} // namespace


TEST_CASE("Waves on the grid lose what upwind fluxes of fifth order take", "[convection][mpi]")
{
  const double crossed = 3 * 0.01 / 0.25; // cells, in the step
  for (const unsigned int n_waves : {2, 3, 4, 6, 8, 12})
    CHECK(1 - left_of_wave(n_waves) ==
          Approx(crossed * 64 / 60 * std::pow(std::sin(pi * n_waves / 24), 6)).epsilon(1e-9));
}


TEMPLATE_TEST_CASE_SIG("Damping of short waves keeps momentum and takes energy",
                       "[convection][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  const auto model = make_model<dim>(
    FluidText{dim == 2 ? "12, 9" : "7, 6, 5",
              boundary("around", every_side<dim>(), "periodic"),
              "",
              "set Grading x = x + 0.1*sin(2*pi*x)/pi\nset Grading y = (x+x^2)/2\n"});
  auto state = model.initial_state();
  fill_scattered(state.velocity);
  for (const double dt : {1e-3, 1e-1, 10.})
    {
      const auto   after  = damped(model, state.velocity, dt);
      const double energy = kinetic_energy(model, state.velocity);
      CHECK(kinetic_energy(model, after) < (1 - 1e-3 * std::min(1., dt)) * energy);
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const auto momentum = [&](const Velocity<dim> &velocity) {
            return sum_over(velocity[axis].lattice(), [&](const GridIndex<dim> &face) {
              return model.grid().dual_volume(axis, face) * velocity[axis](face);
            });
          };
          CHECK(momentum(after) == Approx(momentum(state.velocity)).margin(1e-14));
        }
    }
}


TEST_CASE("Linear velocities have no short waves, on graded grids and between walls",
          "[convection][mpi]")
{
  const auto model = make_model<2>(FluidText{"11, 8", "", "", "set Grading x = x^1.3\n"});
  auto       state = model.initial_state();
  for (unsigned int axis = 0; axis < 2; ++axis)
    for_each(state.velocity[axis].owned(), [&](const GridIndex<2> &face) {
      const auto place           = model.grid().faces(axis)->point(face);
      state.velocity[axis](face) = 1 + 2 * place[0] - 3 * place[1];
    });
  const auto after = damped(model, state.velocity, 0.1);
  for (unsigned int axis = 0; axis < 2; ++axis)
    CHECK(largest_over(after[axis].lattice(), [&](const GridIndex<2> &face) {
            return std::abs(after[axis](face) - state.velocity[axis](face));
          }) < 1e-14);
}


TEST_CASE("Vortices that arrive at wide cells send no waves back", "[convection]")
{
  // A shear layer that waves, carried into cells six times as long: what comes back upstream
  // changes its sign from cell to cell.
  const auto ripple = [](const std::string &short_waves) {
    CoupledRun<2> run(
      steps_of(0.02) +
      section("Domain",
              "set Upper corner = 8, 1\nset Cells = 64, 16\n"
              "set Grading x = if(x<0.75, x/2, 0.375 + (x-0.75)/2 + 8*(x-0.75)^2)") +
      section("Fluid",
              "set Density = 1\nset Initial velocity = 1; 0\n" +
                section("Boundaries",
                        boundary("in", "left", "inflow", "set Velocity = 1; 0.5*sin(8*t)") +
                          boundary("out", "right", "outflow") +
                          boundary("around", "bottom, top", "periodic"))) +
      section("Effects",
              section("convection", "set Form = flux\nset Short waves = " + short_waves) +
                viscosity(1e-4)));
    while (run.state.clock.time < 8 - 1e-9)
      run.step();
    const auto &v   = run.state.fluid.velocity[1];
    double      sum = 0;
    for (int i = 8; i < 40; ++i)
      sum += std::pow(v({{i - 1, 3}}) - 3 * v({{i, 3}}) + 3 * v({{i + 1, 3}}) - v({{i + 2, 3}}), 2);
    return std::sqrt(sum);
  };
  const double kept = ripple("kept"), damped = ripple("damped");
  CAPTURE(kept, damped);
  CHECK(damped < 0.5 * kept);
}
