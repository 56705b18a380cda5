// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/convection/dual_fluxes.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <catch2/catch.hpp>
#include <coupled/obstacle_run.h>
#include <effects/flow_run.h>

using namespace undine_tests;

namespace
{

  template <int dim>
  std::string
  some_flow()
  {
    return dim == 2 ? "1+sin(2*pi*x)*cos(2*pi*y); sin(4*pi*y)+cos(2*pi*x)"
                    : "1+sin(2*pi*x)*cos(2*pi*y); sin(4*pi*y)+cos(2*pi*z); sin(2*pi*(x+z))";
  }


  /// A periodic box of cells of different widths.
  template <int dim>
  FluidText
  periodic_box()
  {
    return {dim == 2 ? "12, 10" : "8, 7, 6",
            boundary("around", every_side<dim>(), "periodic"),
            some_flow<dim>(),
            "set Grading x = x + 0.08*sin(2*pi*x)\nset Grading y = x - 0.07*sin(2*pi*x)",
            1000.,
            section("Pressure solver", "set Divergence tolerance = 1e-13")};
  }


  /// A stream along x that a force of 1 m/s^2 pushes aside for as long as fluid has been inside:
  /// along the last axis it has the velocity x.
  template <int dim>
  FluidText
  pushed_stream()
  {
    return {
      plane_or_space<dim>("16, 4", "16, 4, 3"),
      boundary("in", "left", "inflow", "set Velocity = " + plane_or_space<dim>("1; 0", "1; 0; 0")) +
        boundary("out", "right", "outflow") +
        boundary("around",
                 plane_or_space<dim>("bottom, top", "back, front"),
                 "inflow",
                 "set Velocity = " + plane_or_space<dim>("1; x", "1; 0; x")),
      plane_or_space<dim>("1; x", "1; 0; x")};
  }


  template <int dim>
  std::string
  push()
  {
    return section(
      "body force",
      section("Fluid", "set Acceleration = " + plane_or_space<dim>("0; 1", "0; 0; 1")));
  }


  /// The momentum along `axis` [kg m/s].
  template <int dim>
  double
  momentum(const FlowRun<dim> &run, const unsigned int axis)
  {
    double sum = 0;
    for_each(run.state.velocity[axis].owned(), [&](const GridIndex<dim> &face) {
      sum += run.model.grid().dual_volume(axis, face) * run.state.velocity[axis](face);
    });
    return run.model.density() * dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "As much flows into a dual volume as out of it", "[flows][mpi]", ((int dim), dim), 2, 3)
{
  const FlowRun<dim>    run(periodic_box<dim>(), flux_form());
  const DualFluxes<dim> fluxes(run.model, run.state.velocity, 0);
  for (unsigned int axis = 0; axis < dim; ++axis)
    {
      // The flux of momentum of a uniform velocity, by the sum of what places next to it get.
      double     most = 0;
      Field<dim> sums(run.model.grid().faces(axis));
      fluxes.for_each_between(axis, [&](const auto &from, const auto &to, const double flux) {
        most = std::max(most, std::abs(flux));
        for (const auto &[place, sign] : {std::pair(from, -1.), std::pair(to, 1.)})
          if (sums.owned().contains(place.face))
            sums(place.face) += sign * flux;
      });
      CHECK(most > 1e-3);
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
        {
          // Those that go through periodic sides are booked beyond them.
          const auto inner = [&](const GridIndex<dim> &face) {
            bool result = true;
            for (unsigned int d = 0; d < dim; ++d)
              result = result && face[d] > 0 && face[d] < sums.owned().upper[d] - 1;
            return result;
          };
          for_each(sums.owned(), [&](const GridIndex<dim> &face) {
            if (inner(face))
              REQUIRE(std::abs(sums(face)) <= 1e-11 * most);
          });
        }
    }
}


TEMPLATE_TEST_CASE_SIG("The flux form keeps momentum and adds no energy, whatever the step",
                       "[flows][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const double dt : {0.02, 0.2, 2.})
    {
      FlowRun<dim>            run(periodic_box<dim>(), flux_form());
      double                  energy = kinetic_energy(run.model, run.state.velocity);
      const double            size   = std::sqrt(2 * energy * run.model.density());
      std::array<double, dim> start;
      for (unsigned int axis = 0; axis < dim; ++axis)
        start[axis] = momentum(run, axis);
      for (unsigned int n = 0; n < 5; ++n)
        {
          run.step(dt);
          const double now = kinetic_energy(run.model, run.state.velocity);
          CHECK(now <= energy * (1 + 1e-10));
          energy = now;
        }
      for (unsigned int axis = 0; axis < dim; ++axis)
        CHECK(std::abs(momentum(run, axis) - start[axis]) <= 1e-10 * size);
    }
}


TEST_CASE("Poiseuille's profile passes the flux form unchanged", "[flows]")
{
  FlowRun<2> run(FluidText{"6, 8",
                           boundary("walls", "bottom, top", "no-slip wall") +
                             boundary("in", "left", "inflow", "set Velocity = 4*y*(1-y); 0") +
                             boundary("out", "right", "outflow"),
                           "4*y*(1-y); 0"},
                 flux_form() + viscosity(1.));
  run.run(40, 0.5);
  const auto   exact = [](const auto &place) { return 4 * place[1] * (1 - place[1]); };
  const double error = largest_error(run.state.velocity[0], exact);
  CHECK(error < 0.02);
  CHECK(largest_error(run.state.velocity[1], [](const auto &) { return 0.; }) < 0.01);
}


TEMPLATE_TEST_CASE_SIG("What leaves in flux form leaves no waves behind: a linear profile is kept",
                       "[flows][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const double dt : {0.02, 0.5})
    {
      INFO(dt);
      const unsigned int along = dim - 1;
      FlowRun<dim>       run(pushed_stream<dim>(), flux_form() + push<dim>());
      run.run(static_cast<unsigned int>(2 / dt), dt);
      CHECK(largest_error(run.state.velocity[along], [](const auto &place) { return place[0]; }) <
            1e-8);
    }
}


TEST_CASE("What leaves in flux form over a floor leaves no waves behind, wherever the floor lies",
          "[flows][mpi]")
{
  for (const std::string floor : {"0.25", "0.3"})
    {
      INFO(floor);
      ObstacleRun<3> run(
        pushed_stream<3>(),
        obstacle(
          "floor", "box", "set Lower corner = -1, -1, -1\nset Upper corner = 2, " + floor + ", 2"),
        flux_form() + push<3>(),
        0.1);
      for (unsigned int n = 0; n < 20; ++n)
        run.step();
      CHECK(largest_on_faces<3>(run.state.fluid.velocity,
                                [](const double value, const auto &place, const unsigned int axis) {
                                  return axis == 2 ? std::abs(value - place[0]) : 0.;
                                }) < 1e-8);
    }
}


TEMPLATE_TEST_CASE_SIG("A flow in an open box in flux form only loses energy, whatever the step",
                       "[flows]",
                       ((int dim), dim),
                       2,
                       3)
{
  // Through every side something enters.
  for (const double dt : {.01, .1, 1.})
    {
      INFO(dt);
      FlowRun<dim> run(FluidText{dim == 2 ? "12, 10" : "8, 7, 6",
                                 boundary("around", every_side<dim>(), "outflow"),
                                 some_flow<dim>()},
                       flux_form());
      const double start = kinetic_energy(run.model, run.state.velocity);
      for (unsigned int n = 0; n < 40; ++n)
        {
          run.step(dt);
          CHECK(kinetic_energy(run.model, run.state.velocity) <= start);
        }
    }
}
