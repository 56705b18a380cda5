// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_make_no_slip_surfaces_h
#define undine_operators_make_no_slip_surfaces_h

#include <undine/cutting/cut_workspace.h>
#include <undine/fluid/boundary/no_slip_surfaces.h>
#include <undine/operators/boundary_flux.h>
#include <undine/operators/cut_topology.h>

namespace undine
{
  /// The no-slip surfaces: what of the surface bounds the fluid of each piece of a face, and how
  /// the pieces themselves touch. `cut`, `parts` and `boundary_flux` are those of the surface as
  /// placed. Collective.
  template <int dim>
  NoSlipSurfaces<dim>
  make_no_slip_surfaces(const MacGrid<dim>       &grid,
                        const CutCells<dim>      &cut,
                        const CutTopology<dim>   &parts,
                        const BoundaryFlux<dim>  &boundary_flux,
                        const PlacedSurface<dim> &placed);
} // namespace undine

#endif
