// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/disjoint_sets.h>
#include <undine/coupled/immersed/facet_stiffness.h>
#include <undine/coupled/immersed/follower_pressure.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

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


    /// Centroid [m] of the volume within a closed surface, and that volume [m^dim], with values of
    /// nodes for those of their shares of facets.
    template <int dim>
    std::pair<dealii::Point<dim>, double>
    centroid_and_volume(const std::vector<unsigned int>           &nodes,
                        const std::vector<dealii::Point<dim>>     &places,
                        const std::vector<dealii::Tensor<1, dim>> &areas)
    {
      dealii::Tensor<1, dim> mean, moment;
      for (const unsigned int node : nodes)
        mean += places[node] / double(nodes.size());
      double sum = 0;
      for (const unsigned int node : nodes)
        {
          const auto   arm  = places[node] - mean;
          const double part = areas[node] * dealii::Tensor<1, dim>(arm);
          sum += part;
          moment += part * dealii::Tensor<1, dim>(arm);
        }
      const dealii::Point<dim> middle(mean);
      return {sum > 0 ? middle + dim / (dim + 1.) / sum * moment : middle, sum / dim};
    }


    /// Of a closed part of a surface, see FollowerPressure [Pa].
    template <int dim>
    double
    level_of_pressure(const std::vector<unsigned int>           &nodes,
                      const std::vector<dealii::Point<dim>>     &places,
                      const std::vector<dealii::Tensor<1, dim>> &areas,
                      const std::vector<dealii::Tensor<1, dim>> &loads)
    {
      const auto [centre, volume] = centroid_and_volume(nodes, places, areas);
      double force = 0, square = 0, virial = 0;
      double least = std::numeric_limits<double>::infinity(), most = -least;
      bool   is_all_wet = true;
      for (const unsigned int node : nodes)
        if (loads[node].norm() > 0)
          {
            const double along = -loads[node] * areas[node], area = areas[node].norm_square();
            force += along;
            square += area;
            virial -= loads[node] * (places[node] - centre);
            least = std::min(least, along / area);
            most  = std::max(most, along / area);
          }
        else
          is_all_wet = false;
      if (square == 0)
        return 0;
      return is_all_wet && volume > 0 ? std::clamp(virial / (dim * volume), least, most)
                                      : force / square;
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
    std::map<unsigned int, std::vector<unsigned int>> nodes_of_parts;
    for (unsigned int node = 0; node < pressures.size(); ++node)
      nodes_of_parts[parts.smallest(node)].push_back(node);
    for (const auto &[first, nodes] : nodes_of_parts)
      {
        const double level = level_of_pressure<dim>(nodes, cut_at, where_cut, loads);
        for (const unsigned int node : nodes)
          pressures[node] = level;
      }
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
