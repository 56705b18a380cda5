// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/face_place.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>
#include <undine/fluid/pressure/divergence.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace undine
{
  template <int dim>
  Field<dim>
  divergence(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    const auto         &grid = model.grid();
    Field<dim>          result(grid.cells(), velocity[0].topology());
    const auto         &mine   = result.owned();
    const auto          widths = grid.cell_widths(mine.lower[0], mine.upper[0] - mine.lower[0]);
    std::vector<double> areas;
    for_each_row(mine, [&](const GridIndex<dim> &first, const int n) {
      double *const fluxes = result.data(first);
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const double *below = velocity[axis].data(first);
          const double *above = below + velocity[axis].stride(axis);
          grid.set_face_areas(areas, axis, first, widths);
          for (int i = 0; i < n; ++i)
            fluxes[i] += areas[i] * (above[i] - below[i]);
        }
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
    double     largest = 0;
    bool       finite  = true;
    const auto include = [&](const double flux, const double area) {
      finite  = finite && std::isfinite(flux);
      largest = std::max(largest, std::abs(flux) / area);
    };
    const auto         &grid    = model.grid();
    const auto         &mine    = fluxes.owned();
    const auto         *divided = fluxes.divided();
    const auto          widths  = grid.cell_widths(mine.lower[0], mine.upper[0] - mine.lower[0]);
    std::vector<double> areas;
    for_each_row(mine, [&](const GridIndex<dim> &first, const int n) {
      const double *flux     = fluxes.data(first);
      double        shortest = std::numeric_limits<double>::infinity();
      for (unsigned int d = 1; d < dim; ++d)
        shortest = std::min(shortest, grid.cell_width(d, first[d]));
      grid.set_face_areas(areas, 0, first, widths);
      for (int i = 0; i < n; ++i)
        if (is_whole(divided, moved<dim>(first, 0, i)))
          include(flux[i], areas[i] * widths[i] / std::min(widths[i], shortest));
    });
    for_each_part(fluxes, [&](const double flux, const auto &, const GridIndex<dim> &cell) {
      include(flux, flux_area(grid, cell));
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
