// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_sampled_regions_h
#define undine_operators_sampled_regions_h

#include <undine/operators/cut_topology.h>

namespace undine
{
  /// Mark as VoidMask::solid, among the fluid that `voids` leaves, the closed regions that lie
  /// in sampled cells alone: what overlapping bodies seem to enclose between them is no larger than
  /// the resolution of the samples, and fluid that moving bodies displace there could not leave.
  /// `parts` comes from make_cut_topology(grid, cut, voids) and must be made anew afterwards.
  /// Collective.
  template <int dim>
  void
  close_sampled_regions(VoidMask               &voids,
                        const MacGrid<dim>     &grid,
                        const CutCells<dim>    &cut,
                        const CutTopology<dim> &parts);
} // namespace undine

#endif
