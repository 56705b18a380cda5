// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_pressure_place_at_h
#define undine_operators_pressure_place_at_h

#include <undine/fluid/grid/fluid_topology.h>
#include <undine/fluid/grid/pressure_numbers.h>
#include <undine/fluid/visibility/obstruction.h>

namespace undine
{
  /// Where the pressure sits that holds at `point` [m], which must be in a cell that this rank
  /// knows. `open`: nullptr if nothing is cut. Throws SolveError, whose message begins with "lies",
  /// if the point is not in the fluid, or too near to a surface to tell on which side it is; on
  /// this rank only.
  template <int dim>
  PressurePlace<dim>
  pressure_place_at(const dealii::Point<dim> &point,
                    const MacGrid<dim>       &grid,
                    const FluidTopology<dim> *open,
                    const Obstruction<dim>   *obstruction);
} // namespace undine

#endif
