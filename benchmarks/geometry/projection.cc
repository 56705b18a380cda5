// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/pressure/projection.h>

#include <catch2/catch.hpp>
#include <fluid/fluid_scene.h>

#include "stopwatch.h"

#include <iostream>

using namespace undine_benchmarks;
using namespace undine_tests;

namespace
{
  template <int dim>
  void
  measure(const std::string &name, const std::string &text)
  {
    const auto      model = make_model<dim>(text);
    Projection<dim> projection(model);
    auto            state = model.initial_state();
    fill_scattered(state.velocity);
    typename Projection<dim>::Report first, second;

    const double with_setup = seconds([&] { first = projection.project(state, 0, 0.01); });
    fill_scattered(state.velocity);
    state.pressure     = Field<dim>(model.grid().cells());
    const double alone = seconds([&] { second = projection.project(state, 0, 0.01); });
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << fmt::format("{:30} {:9} cells, setup {:6.2f} s, solve {:6.2f} s, {} iterations, "
                               "divergence {:.2g}\n",
                               name,
                               model.grid().n_cells(),
                               with_setup - alone,
                               alone,
                               second.iterations,
                               second.divergence);
    CHECK(second.divergence <= 1e-10);
  }
} // namespace


TEST_CASE("a projection of a million cells, cold start from noise")
{
  const auto open = boundary("out", "right", "outflow");
  measure<3>("3D 100^3, outflow", FluidText{"100, 100, 100", open});
  measure<3>("3D 100^3, closed", FluidText{"100, 100, 100"});
  measure<2>("2D 1000^2, outflow", FluidText{"1000, 1000", open});
  measure<2>("2D 1000^2, closed", FluidText{"1000, 1000"});
}
