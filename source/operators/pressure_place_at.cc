// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/operators/pressure_place_at.h>

#include <vector>

namespace undine
{
  template <int dim>
  PressurePlace<dim>
  pressure_place_at(const dealii::Point<dim> &point,
                    const MacGrid<dim>       &grid,
                    const FluidTopology<dim> *open,
                    const Obstruction<dim>   *obstruction)
  {
    using Kind      = typename SubLattice<dim>::Kind;
    const auto cell = grid.cell_at(point);
    if (open == nullptr || open->cells.kind(cell) == Kind::whole)
      return {cell, -1};
    if (open->cells.kind(cell) == Kind::closed)
      throw SolveError("lies in a body or in a void region");
    std::vector<int> visible;
    for (int c = open->cells.first(cell); c < open->cells.last(cell); ++c)
      if (obstruction->first_hit(point, open->cells.all()[c].place) > 1)
        visible.push_back(c);
    if (visible.size() != 1)
      throw SolveError("lies in a body or too near to one to tell on which side");
    return {cell, visible[0]};
  }


  template PressurePlace<2>
  pressure_place_at(const dealii::Point<2> &,
                    const MacGrid<2> &,
                    const FluidTopology<2> *,
                    const Obstruction<2> *);
  template PressurePlace<3>
  pressure_place_at(const dealii::Point<3> &,
                    const MacGrid<3> &,
                    const FluidTopology<3> *,
                    const Obstruction<3> *);
} // namespace undine
