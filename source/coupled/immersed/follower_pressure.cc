// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/disjoint_sets.h>
#include <undine/coupled/immersed/facet_stiffness.h>
#include <undine/coupled/immersed/follower_pressure.h>

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


  template <int dim>
  void
  FollowerPressure<dim>::subtract_stiffness(Matrix       &tangent,
                                            const double  factor,
                                            const Vector &displacement) const
  {
    if (!is_on())
      return;
    const auto &facets = surface.bodies()->surface();
    add_facet_stiffness(
      tangent,
      surface,
      surface.bodies()->positions(displacement),
      [&](const unsigned int facet, const auto &positions) {
        return area_vector(facets, facet, positions);
      },
      [&](const unsigned int facet, const unsigned int k) {
        return factor * pressures[facets.facets()[facet][k]] / dim;
      });
  }


  template class FollowerPressure<2>;
  template class FollowerPressure<3>;
} // namespace undine
