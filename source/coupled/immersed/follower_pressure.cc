// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/disjoint_sets.h>
#include <undine/coupled/immersed/follower_pressure.h>

#include <deal.II/base/bounding_box.h>

namespace undine
{
  namespace
  {
    /// Each facet gives an equal share of its area vector, out of the solid, to each of its nodes.
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    area_vectors_of_nodes(const Surface<dim>                    &surface,
                          const std::vector<dealii::Point<dim>> &positions)
    {
      std::vector<dealii::Tensor<1, dim>> result(positions.size());
      for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
        {
          const auto share = area_vector(surface, facet, positions) / dim;
          for (const unsigned int node : surface.facets()[facet])
            result[node] += share;
        }
      return result;
    }
  } // namespace


  template <int dim>
  FollowerPressure<dim>::FollowerPressure(const ImmersedSurface<dim> &surface,
                                          const Positions            &cut_at,
                                          const Vectors              &loads)
    : surface(surface)
    , where_cut(
        area_vectors_of_nodes(surface.bodies()->surface(),
                              Positions(cut_at.begin(), cut_at.begin() + surface.n_body_nodes())))
    , pressures(surface.n_body_nodes())
  {
    DisjointSets parts(pressures.size());
    for (const auto &facet : surface.bodies()->surface().facets())
      for (const unsigned int node : facet)
        parts.join(node, facet[0]);
    std::vector<double> force(pressures.size()), area(pressures.size());
    for (unsigned int node = 0; node < pressures.size(); ++node)
      if (loads[node].norm() > 0)
        {
          force[parts.smallest(node)] -= loads[node] * where_cut[node];
          area[parts.smallest(node)] += where_cut[node].norm_square();
        }
    for (unsigned int node = 0; node < pressures.size(); ++node)
      if (const auto part = parts.smallest(node); area[part] > 0)
        pressures[node] = force[part] / area[part];
  }


  template <int dim>
  typename FollowerPressure<dim>::Vectors
  FollowerPressure<dim>::forces(const Vector &displacement) const
  {
    Vectors result(surface.surface().n_nodes());
    if (!is_on())
      return result;
    const auto now =
      area_vectors_of_nodes(surface.bodies()->surface(), surface.bodies()->positions(displacement));
    for (unsigned int node = 0; node < pressures.size(); ++node)
      if (surface.moves(node))
        result[node] = -pressures[node] * (now[node] - where_cut[node]);
    return result;
  }


  /// An area vector is an affine function of the place of each single node, so that differences
  /// over any length are derivatives, of facets without an area, too.
  template <int dim>
  void
  FollowerPressure<dim>::subtract_stiffness(Matrix       &tangent,
                                            const double  factor,
                                            const Vector &displacement) const
  {
    if (!is_on())
      return;
    const auto &bodies    = *surface.bodies();
    const auto &facets    = bodies.surface();
    auto        positions = bodies.positions(displacement);
    const auto  corners   = dealii::BoundingBox<dim>(positions).get_boundary_points();
    const auto  length    = corners.first.distance(corners.second);
    for (unsigned int facet = 0; facet < facets.facets().size(); ++facet)
      for (const unsigned int moved : facets.facets()[facet])
        for (unsigned int axis = 0; axis < dim && surface.moves(moved); ++axis)
          {
            const auto place  = positions[moved];
            const auto before = area_vector(facets, facet, positions);
            positions[moved][axis] += length;
            const auto change = (area_vector(facets, facet, positions) - before) / length;
            positions[moved]  = place;
            for (const unsigned int node : facets.facets()[facet])
              if (surface.moves(node))
                bodies.add_derivative(
                  tangent, node, moved, axis, factor * pressures[node] / dim * change);
          }
    tangent.compress(dealii::VectorOperation::add);
  }


  template class FollowerPressure<2>;
  template class FollowerPressure<3>;
} // namespace undine
