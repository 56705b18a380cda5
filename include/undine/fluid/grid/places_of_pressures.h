// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_places_of_pressures_h
#define undine_fluid_grid_places_of_pressures_h

#include <undine/base/multigrid/cell_equations.h>
#include <undine/fluid/grid/pressure_numbers.h>

namespace undine
{
  /// The cells of the pressures that this rank owns, in the order of their numbers.
  template <int dim>
  CellsOfUnknowns
  places_of_pressures(const MacGrid<dim> &grid, const PressureNumbers<dim> &numbers)
  {
    PlanesOfCells planes{{{0, 1}, {0, 1}, {0, 1}}};
    for (unsigned int axis = 0; axis < dim; ++axis)
      planes[axis] = grid.planes(axis);
    CellsOfUnknowns result;
    result.planes = std::make_shared<const PlanesOfCells>(std::move(planes));
    const Field<dim> pressures(grid.cells(), numbers.topology());
    for_each_value(pressures, [&](const double, const auto &, const GridIndex<dim> &cell) {
      std::array<int, 3> index{};
      std::copy_n(cell.values, dim, index.begin());
      result.cells.push_back(index);
    });
    return result;
  }
} // namespace undine

#endif
