// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <catch2/catch.hpp>
#include <effects/flow_run.h>

using namespace undine_tests;

namespace
{
  /// What the effect alone does to the velocity in a unit of time, on a grid of `n` cells along
  /// each axis: at once, before anything else.
  template <int dim>
  Velocity<dim>
  confining_acceleration(const std::string &fluid, const double strength)
  {
    const auto options =
      read_scene_text(fluid + section("Effects",
                                      section("vorticity confinement",
                                              fmt::format("set Strength = {}", strength))));
    const FluidModel<dim> model(options, MPI_COMM_WORLD);
    const auto            effects = make_effects<dim>(options);
    auto                  state   = model.initial_state();
    const auto            before  = state.velocity;
    TimingTree            timing;
    FluidStage<dim>       step(model, state, {}, 0, single_stage(1.), timing);
    effects[0]->accelerate(step);
    auto result = state.velocity;
    add(result, -1., before);
    CHECK(timing.memory.of("vorticity confinement").peak > 0);
    return result;
  }


  /// Parallel flow along the axis `flows` between periodic sides, which varies along `varies`, with
  /// n cells there and 4 along the others.
  template <int dim>
  std::string
  parallel_flow(const unsigned int n, const unsigned int varies = 0, const unsigned int flows = 1)
  {
    std::string cells, velocity;
    for (unsigned int d = 0; d < dim; ++d)
      {
        cells += (d > 0 ? ", " : "") + std::to_string(d == varies ? n : 4);
        velocity += std::string(d > 0 ? "; " : "") +
                    (d == flows ? fmt::format("cos(2*pi*{})/(2*pi)", "xyz"[varies]) : "0");
      }
    return FluidText{cells, boundary("around", every_side<dim>(), "periodic"), velocity};
  }


  /// Largest error of the acceleration by 3/s in that flow, v = cos(kx)/k: omega = -sin(kx), N =
  /// grad|omega|/..., f = epsilon dx sin(kx) sign(d|sin(kx)|/dx). Away from zeros and peaks of
  /// omega it is smooth; across the flow there is none.
  template <int dim>
  double
  error_in_parallel_flow(const unsigned int n,
                         const unsigned int varies = 0,
                         const unsigned int flows  = 1)
  {
    const auto   push = confining_acceleration<dim>(parallel_flow<dim>(n, varies, flows), 3);
    const double k    = 2 * dealii::numbers::PI;
    // In 3D cells are wider along the other axes: their mean width counts.
    const double width   = std::pow(std::pow(0.25, dim - 1) / n, 1. / dim);
    double       largest = 0;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for_each(push[axis].owned(), [&](const auto &face) {
        const double x = push[axis].lattice().point(face)[varies];
        const double s = std::sin(k * x), slope = std::cos(k * x) * (s > 0 ? 1 : -1);
        if (std::abs(s) < 0.3 || std::abs(slope) < 0.3)
          return;
        const double exact = axis == flows ? s * (slope > 0 ? 1 : -1) : 0;
        largest            = std::max(largest, std::abs(push[axis](face) / (3 * width) - exact));
      });
    return dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
  }
} // namespace


TEST_CASE("confinement drives a parallel flow as its equation says", "[vorticity][mpi]")
{
  const double coarse = error_in_parallel_flow<2>(32);
  const double fine   = error_in_parallel_flow<2>(64);
  CHECK(coarse < 0.01);
  CHECK(std::log2(coarse / fine) > 1.9);
  CHECK(error_in_parallel_flow<2>(32, 1, 0) == Approx(coarse).epsilon(1e-6));
  for (unsigned int varies = 0; varies < 3; ++varies)
    for (unsigned int flows = 0; flows < 3; ++flows)
      if (flows != varies)
        {
          INFO("along "
               << "xyz"[flows] << ", varies along "
               << "xyz"[varies]);
          CHECK(error_in_parallel_flow<3>(32, varies, flows) == Approx(coarse).epsilon(1e-6));
        }
}


TEST_CASE("confinement spins vortices of either sense faster, about their cores",
          "[vorticity][mpi]")
{
  for (const double sense : {1., -1.})
    {
      // A Gaussian vortex in a box with walls.
      const auto push =
        confining_acceleration<2>(FluidText{"40, 40",
                                            "",
                                            fmt::format("{0}*(0.5-y)*exp(-40*((x-.5)^2+(y-.5)^2)); "
                                                        "{0}*(x-0.5)*exp(-40*((x-.5)^2+(y-.5)^2))",
                                                        sense)},
                                  2);
      double torque = 0;
      for (const unsigned int axis : {0, 1})
        torque += sum_over(push[axis].lattice(), [&](const auto &face) {
          const auto place = push[axis].lattice().point(face);
          // Within the core, where vorticity has the sense of the vortex.
          if (place.distance(dealii::Point<2>(.5, .5)) > 0.1)
            return 0.;
          return (axis == 0 ? .5 - place[1] : place[0] - .5) * push[axis](face);
        });
      CHECK(torque * sense > 0.01);
    }
}


TEST_CASE("confinement leaves even vorticity, walls and their neighbours alone", "[vorticity][mpi]")
{
  const auto even = confining_acceleration<2>(FluidText{"12, 12", "", "-y; x"}, 5);
  for (const unsigned int axis : {0, 1})
    CHECK(largest_over(even[axis].lattice(),
                       [&](const auto &face) { return std::abs(even[axis](face)); }) == 0);
  // A sheared flow along a wall: nothing on faces of the cells at walls but those that the next
  // cells share.
  const auto sheared = confining_acceleration<2>(FluidText{"12, 12", "", "y^2; 0"}, 5);
  double     inside  = 0;
  for_each(sheared[0].owned(), [&](const GridIndex<2> &face) {
    const double value = std::abs(sheared[0](face));
    if (face[1] == 0 || face[1] == 11 || face[0] == 0 || face[0] == 12)
      CHECK(value == 0);
    else
      inside = std::max(inside, value);
  });
  CHECK(dealii::Utilities::MPI::max(inside, MPI_COMM_WORLD) > 0.1);
}
