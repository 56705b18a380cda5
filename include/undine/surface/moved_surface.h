// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_moved_surface_h
#define undine_surface_moved_surface_h

#include <undine/surface/facet_geometry.h>
#include <undine/surface/surface.h>

#include <vector>

namespace undine
{
  /// A surface and its motion during the last step.
  template <int dim>
  struct MovedSurface
  {
    const Surface<dim>                 *surface;
    std::vector<dealii::Point<dim>>     old_positions; ///< of the nodes, before the step [m]
    std::vector<dealii::Point<dim>>     positions;     ///< after it [m]
    std::vector<dealii::Tensor<1, dim>> velocities;    ///< [m/s]
    unsigned int n_free_nodes = 0; ///< the first ones, whose motion follows from forces

    /// Where the nodes of a facet are [m].
    FacetNodes<dim>
    nodes(const unsigned int facet) const
    {
      return nodes_at(positions, facet);
    }

    /// Where they were before the step [m].
    FacetNodes<dim>
    old_nodes(const unsigned int facet) const
    {
      return nodes_at(old_positions, facet);
    }

  private:
    FacetNodes<dim>
    nodes_at(const std::vector<dealii::Point<dim>> &places, const unsigned int facet) const
    {
      FacetNodes<dim> result;
      for (unsigned int k = 0; k < dim; ++k)
        result[k] = places[surface->facets()[facet][k]];
      return result;
    }
  };
} // namespace undine

#endif
