// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_enclosed_volume_h
#define undine_operators_enclosed_volume_h

#include <undine/cutting/cut_cells.h>
#include <undine/fluid/grid/mac_grid.h>
#include <undine/surface/surface.h>

#include <array>
#include <vector>

namespace undine
{
  /// What bounds a region of fluid, as the grid has been cut.
  template <int dim>
  struct RegionBoundary
  {
    std::vector<bool>           has_component; ///< [CutCells::components], of owned cells
    std::array<double, 2 * dim> side_areas; ///< of the domain's sides, over all ranks [m^(dim-1)]
  };


  /// The volume [m^dim] of a region of fluid between surfaces whose nodes are at `positions` [m],
  /// by the divergence theorem along one axis a that is not periodic,
  ///
  ///     V = A_upper (upper_a - c) - sum over facets of N_a (mean x_a - c), (C4)
  ///
  /// N being the area vector, out of the solid, of the part of a facet inside the domain, and c the
  /// place of a side that bounds the region, so that it contributes nothing. The grid, cut with the
  /// nodes at `cut_at`, only says which facets bound the region: the volume is that of the surfaces
  /// themselves, however far they have been moved for the cut. Two things are the grid's: which
  /// parts of a facet bound the region if not all of it does, and A_upper, which is zero unless the
  /// region reaches from one side to the other along every axis. Collective.
  template <int dim>
  double
  enclosed_volume(const MacGrid<dim>                    &grid,
                  const CutCells<dim>                   &cut,
                  const Surface<dim>                    &surface,
                  const std::vector<dealii::Point<dim>> &cut_at,
                  const std::vector<dealii::Point<dim>> &positions,
                  const RegionBoundary<dim>             &boundary);
} // namespace undine

#endif
