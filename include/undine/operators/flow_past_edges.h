// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_flow_past_edges_h
#define undine_operators_flow_past_edges_h

#include <undine/cutting/cut_workspace.h>
#include <undine/fluid/boundary/no_slip_surfaces.h>
#include <undine/fluid/grid/mac_grid.h>
#include <undine/operators/cut_topology.h>

#include <vector>

namespace undine
{
  /// Of all pieces of faces normal to `axis`, how fluid flows past the edges of bodies beside them
  /// (I14). `cut` must come from a block of this rank's cells with a halo. Collective.
  template <int dim>
  std::vector<FlowPastEdge<dim>>
  flow_past_edges(const MacGrid<dim>       &grid,
                  const CutCells<dim>      &cut,
                  const CutTopology<dim>   &parts,
                  const PlacedSurface<dim> &placed,
                  const unsigned int        axis);
} // namespace undine

#endif
