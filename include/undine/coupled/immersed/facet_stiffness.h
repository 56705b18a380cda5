// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_facet_stiffness_h
#define undine_coupled_immersed_facet_stiffness_h

#include <undine/surface/immersed_surface.h>

#include <deal.II/base/bounding_box.h>

#include <vector>

namespace undine
{
  /// Add to a tangent of the bodies how forces in the nodes of facets, `load(facet, k)` [Pa] of its
  /// k-th node times `area(facet, positions)` [m^(dim-1)], change with the `positions` [m] of
  /// nodes. That must be an affine function of the place of each single node, as area vectors are,
  /// so that differences over any length are derivatives, of facets without an area, too.
  /// Collective.
  template <int dim, class Area, class Load>
  void
  add_facet_stiffness(typename BodySurface<dim>::Matrix     &tangent,
                      const ImmersedSurface<dim>            &surface,
                      const std::vector<dealii::Point<dim>> &positions,
                      const Area                            &area,
                      const Load                            &load)
  {
    const auto &facets  = surface.bodies()->surface().facets();
    const auto  corners = dealii::BoundingBox<dim>(positions).get_boundary_points();
    const auto  length  = corners.first.distance(corners.second);
    auto        places  = positions;
    for (unsigned int facet = 0; facet < facets.size(); ++facet)
      {
        const auto                              &nodes = facets[facet];
        typename BodySurface<dim>::FacetMatrices changes;
        const auto                               here = area(facet, positions);
        for (unsigned int m = 0; m < dim; ++m)
          for (unsigned int axis = 0; axis < dim && surface.moves(nodes[m]); ++axis)
            {
              places[nodes[m]][axis] += length;
              const auto change = (area(facet, places) - here) / length;
              places[nodes[m]]  = positions[nodes[m]];
              for (unsigned int k = 0; k < dim; ++k)
                for (unsigned int i = 0; i < dim && surface.moves(nodes[k]); ++i)
                  changes[k][m][i][axis] = load(facet, k) * change[i];
            }
        surface.bodies()->add_derivatives(tangent, nodes, changes);
      }
    tangent.compress(dealii::VectorOperation::add);
  }
} // namespace undine

#endif
