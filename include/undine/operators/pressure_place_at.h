// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_pressure_place_at_h
#define undine_operators_pressure_place_at_h

#include <undine/fluid/grid/fluid_topology.h>
#include <undine/fluid/grid/pressure_numbers.h>
#include <undine/fluid/visibility/obstruction.h>

namespace undine
{
  /// Where the pressure sits that a point of a cell of this rank has. `open`: nullptr if nothing
  /// stands in the fluid. Throws SolveError, whose message begins with "lies", if that is no fluid,
  /// or if the point is too near to a surface to tell on which side it is.
  template <int dim>
  PressurePlace<dim>
  pressure_place_at(const dealii::Point<dim> &point,
                    const MacGrid<dim>       &grid,
                    const FluidTopology<dim> *open,
                    const Obstruction<dim>   *obstruction);
} // namespace undine

#endif
