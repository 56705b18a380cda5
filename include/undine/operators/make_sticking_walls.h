// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_make_sticking_walls_h
#define undine_operators_make_sticking_walls_h

#include <undine/cutting/cut_workspace.h>
#include <undine/fluid/boundary/sticking_walls.h>
#include <undine/operators/boundary_flux.h>
#include <undine/operators/cut_parts.h>

namespace undine
{
  /// Where the planes of faces meet the surface; without masses. `cut`, `parts` and `boundary_flux`
  /// are those of the surface as placed. Collective.
  template <int dim>
  StickingWalls<dim>
  make_sticking_walls(const MacGrid<dim>       &grid,
                      const CutCells<dim>      &cut,
                      const CutParts<dim>      &parts,
                      const BoundaryFlux<dim>  &boundary_flux,
                      const PlacedSurface<dim> &placed);
} // namespace undine

#endif
