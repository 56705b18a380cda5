// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/checkpoint/checkpoint.h>
#include <undine/output/fields/fluid_sampler.h>
#include <undine/output/fields/solution_parts.h>

#include <catch2/catch.hpp>

#include "obstacle_scene.h"

using namespace undine_tests;

namespace
{
  template <class Number>
  Number
  sum(const Number number)
  {
    return dealii::Utilities::MPI::sum(number, MPI_COMM_WORLD);
  }


  /// The measure of a simplex in space.
  template <int dim>
  double
  area(const dealii::DataOutBase::Patch<dim - 1, dim> &patch)
  {
    const dealii::Tensor<1, dim> a = patch.vertices[1] - patch.vertices[0];
    const dealii::Tensor<1, dim> b = patch.vertices[dim - 1] - patch.vertices[0];
    return dim == 2 ? a.norm()
                    : std::sqrt(a.norm_square() * b.norm_square() - (a * b) * (a * b)) / 2;
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("checkpoint: parts of divided points and surfaces, on any number of ranks",
                       "[checkpoint][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  TemporaryFolder          folder;
  const ObstacleScene<dim> together(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  // Of a state that was cut elsewhere, with other parts.
  const auto written = together.filled_state(0.2);
  REQUIRE(sum(written.fluid.pressure.parts().size()) > 0);
  write_checkpoint(folder.path / "together", together.models, written);
  auto read = together.zero_state(0);
  CHECK(ObstacleScene<dim>::difference(read, written) > 1);
  read_checkpoint(folder.path / "together", together.models, read);
  CHECK(ObstacleScene<dim>::difference(read, written) == 0);

  auto read_alone = alone.zero_state(0);
  read_checkpoint(folder.path / "together", alone.models, read_alone);
  CHECK(ObstacleScene<dim>::difference(read_alone, alone.filled_state(0.2)) == 0);

  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    write_checkpoint(folder.path / "alone", alone.models, alone.filled_state(0.3));
  MPI_Barrier(MPI_COMM_WORLD);
  auto read_together = together.zero_state(0);
  read_checkpoint(folder.path / "alone", together.models, read_together);
  CHECK(ObstacleScene<dim>::difference(read_together, together.filled_state(0.3)) == 0);
}


TEMPLATE_TEST_CASE_SIG("fluid sampler: nothing is seen through a thin wall; in it, its motion",
                       "[probe][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  const ObstacleScene<dim> scene(MPI_COMM_WORLD);
  const double             time  = 0.02; // the wall is in one layer of cells, from 0.47 to 0.49
  auto                     state = scene.filled_state(time);
  for (auto *field : {&state.fluid.pressure, &state.fluid.scalars.at("smoke")})
    {
      for_each(field->owned(), [&](const auto &index) {
        (*field)(index) = field->lattice().point(index)[0] < 0.48 ? -3 : 7;
      });
      for (std::size_t k = 0; k < field->parts().size(); ++k)
        field->parts()[k] = field->divided()->all()[k].place[0] < 0.48 ? -3 : 7;
    }
  const FluidSampler<dim> sampler(scene.models, state);
  for (const double x : {0.3, 0.44, 0.4699, 0.4701, 0.48, 0.4899, 0.4901, 0.52, 0.6})
    for (const double y : {0.01, 0.3, 0.55, 0.99})
      {
        dealii::Point<dim> place;
        for (unsigned int axis = 1; axis < dim; ++axis)
          place[axis] = y;
        place[0]         = x;
        const auto &grid = scene.models.fluid->grid();
        if (!grid.cells()->owned().contains(grid.cell_at(place)))
          continue;
        CAPTURE(x, y);
        if (x < 0.47 || x > 0.49)
          {
            CHECK(sampler.pressure(place) == Approx(x < 0.47 ? -3 : 7));
            CHECK(sampler.scalars(place)[0] == Approx(x < 0.47 ? -3 : 7));
          }
        else
          CHECK(sampler.velocity(place)[0] == Approx(1));
      }
}


TEMPLATE_TEST_CASE_SIG(
  "solution: voxels hold the fluid's volume, surfaces the pressure of both sides",
  "[solution][mpi]",
  ((int dim), dim),
  2,
  3)
{
  const ObstacleScene<dim> scene(MPI_COMM_WORLD);
  auto                     state    = scene.zero_state(0.02);
  auto                    &pressure = state.fluid.pressure;
  for (std::size_t k = 0; k < pressure.parts().size(); ++k)
    pressure.parts()[k] = pressure.divided()->all()[k].place[0] < 0.48 ? -3 : 7;

  const auto         fluid    = solution_parts(scene.models, state)[0];
  const unsigned int fraction = fluid.components.size() - 1;
  REQUIRE(fluid.components[fraction] == "fluid_fraction");
  double volume = 0;
  for (const auto &patch : fluid.patches)
    {
      double box = 1;
      for (unsigned int axis = 0; axis < dim; ++axis)
        box *= patch.vertices[(1 << dim) - 1][axis] - patch.vertices[0][axis];
      volume += box * patch.data(fraction, 0);
    }
  CHECK(sum(volume) == Approx(0.98));

  const auto surfaces = surface_parts(scene.models, state);
  REQUIRE(surfaces.size() == 2);
  CHECK(surfaces[0].name == "obstacles");
  CHECK(sum(surfaces[0].patches.size()) == scene.models.surface->surface().facets().size());
  CHECK(surfaces[1].name == "surface");
  double left = 0, right = 0;
  for (const auto &patch : surfaces[1].patches)
    {
      const bool is_left = patch.vertices[0][0] < 0.48;
      (is_left ? left : right) += area<dim>(patch);
      CHECK(patch.data(dim, 0) == Approx(is_left ? -3 : 7));
      CHECK(patch.data(0, 0) == Approx(1));
    }
  CHECK(sum(left) == Approx(1));
  CHECK(sum(right) == Approx(1));
}
