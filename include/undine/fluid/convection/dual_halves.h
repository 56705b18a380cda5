// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_convection_dual_halves_h
#define undine_fluid_convection_dual_halves_h

#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/grid/mac_grid.h>

namespace undine
{
  /// The halves of the dual volumes V_f, in the cells below [0] and above [1] each face and each
  /// piece [m^dim]; their sums are V_f. One ghost layer is up to date. Collective.
  template <int dim>
  DualHalves<dim>
  dual_halves(const MacGrid<dim> &grid, const std::shared_ptr<const FluidTopology<dim>> &topology);
} // namespace undine

#endif
