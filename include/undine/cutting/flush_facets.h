// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_flush_facets_h
#define undine_cutting_flush_facets_h

#include <undine/cutting/grid_planes.h>
#include <undine/surface/surface.h>

#include <vector>

namespace undine
{
  /// How near a facet must lie to a plane of the grid to count as lying in it, in units of the
  /// narrower cell beside the plane.
  constexpr double flush_reach = 1e-3;

  /// The positions [nodes] [m] at which surfaces shall cut the grid, for nodes at `positions`:
  /// facets that lie along a plane inside the grid, on the solid's side of it or in it, are moved
  /// to where the solid reaches just beyond the plane. Between them and the plane there would be
  /// components of almost no thickness, each with a pressure of its own, through which fluid flows
  /// around the corners of bodies; two sides of a body, one on either side of a plane, would
  /// differ. Facets stay where two of them face each other at the same plane: the gap of fluid
  /// between them must stay open. Nodes that are next to a side of the grid but for rounding are
  /// put onto it.
  template <int dim>
  std::vector<dealii::Point<dim>>
  beyond_planes(const GridPlanes<dim>                 &planes,
                const Surface<dim>                    &surface,
                const std::vector<dealii::Point<dim>> &positions);
} // namespace undine

#endif
