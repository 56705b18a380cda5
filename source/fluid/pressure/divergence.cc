// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>
#include <undine/fluid/pressure/divergence.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  template <int dim>
  Field<dim>
  divergence(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    const auto &grid = model.grid();
    Field<dim>  result(grid.cells(), velocity[0].topology());
    for_each(result.owned(), [&](const GridIndex<dim> &cell) {
      for (unsigned int axis = 0; axis < dim; ++axis)
        result(cell) += grid.face_area(axis, cell) *
                        (velocity[axis](moved<dim>(cell, axis, 1)) - velocity[axis](cell));
    });
    if (const auto *open = velocity.topology())
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (std::size_t k = 0; k < open->pieces[axis].size(); ++k)
          for (const unsigned int end : {0, 1})
            if (const int component = open->pieces[axis][k].components[end]; component >= 0)
              result.parts()[component] += (end == 0 ? 1 : -1) *
                                           open->faces[axis].all()[k].measure *
                                           velocity[axis].parts()[k];
    return result;
  }


  template <int dim>
  double
  flux_area(const MacGrid<dim> &grid, const GridIndex<dim> &cell)
  {
    double width = grid.cell_width(0, cell[0]);
    for (unsigned int d = 1; d < dim; ++d)
      width = std::min(width, grid.cell_width(d, cell[d]));
    return grid.cell_volume(cell) / width;
  }


  template <int dim>
  double
  largest_divergence(const FluidModel<dim> &model, const Field<dim> &fluxes)
  {
    double largest = 0;
    bool   finite  = true;
    for_each_value(fluxes, [&](const double flux, const auto &, const GridIndex<dim> &cell) {
      finite  = finite && std::isfinite(flux);
      largest = std::max(largest, std::abs(flux) / flux_area(model.grid(), cell));
    });
    throw_unless_finite(finite, model.grid().communicator());
    return dealii::Utilities::MPI::max(largest, model.grid().communicator());
  }


  template <int dim>
  double
  largest_divergence(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    auto known = velocity;
    exchange(known);
    return largest_divergence(model, divergence(model, known));
  }


#define INSTANTIATE(dim)                                                               \
  template Field<dim> divergence(const FluidModel<dim> &, const Velocity<dim> &);      \
  template double     flux_area(const MacGrid<dim> &, const GridIndex<dim> &);         \
  template double     largest_divergence(const FluidModel<dim> &, const Field<dim> &); \
  template double     largest_divergence(const FluidModel<dim> &, const Velocity<dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
