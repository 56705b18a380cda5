// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/contact/collision_free_fraction.h>
#include <undine/contact/contact_boxes.h>
#include <undine/surface/nearest_in_simplex.h>
#include <undine/surface/nearest_of_edges.h>

#include <algorithm>
#include <array>

namespace undine
{
  namespace
  {
    /// What a gap that was wide may close to.
    double
    closest(const double activation_distance)
    {
      return activation_distance / 2;
    }


    /// A node and a facet on their straight paths.
    template <int dim>
    struct NodeAndFacet
    {
      dealii::Point<dim>                  node;
      std::array<dealii::Point<dim>, dim> facet;
      dealii::Tensor<1, dim>              path;      ///< of the node against the facet's middle
      double                              speed = 0; ///< bound for the change of the distance

      std::array<dealii::Tensor<1, dim>, dim> increments;

      double
      distance(const double part) const
      {
        Simplex<dim>                        simplex;
        std::array<dealii::Point<dim>, dim> corners;
        simplex.n = dim;
        for (unsigned int k = 0; k < dim; ++k)
          {
            simplex.nodes[k] = k;
            corners[k]       = facet[k] + part * increments[k];
          }
        return nearest_in_simplex<dim>(simplex, corners, node + part * path).distance;
      }
    };


    template <int dim>
    NodeAndFacet<dim>
    node_and_facet(const std::vector<dealii::Point<dim>> &from,
                   const std::vector<dealii::Point<dim>> &to,
                   const unsigned int                     node,
                   const std::array<unsigned int, dim>   &facet)
    {
      NodeAndFacet<dim>      result;
      dealii::Tensor<1, dim> mean;
      for (const unsigned int corner : facet)
        mean += (to[corner] - from[corner]) / dim;
      double spread = 0;
      for (unsigned int k = 0; k < dim; ++k)
        {
          result.facet[k]      = from[facet[k]];
          result.increments[k] = to[facet[k]] - from[facet[k]] - mean;
          spread               = std::max(spread, result.increments[k].norm());
        }
      result.node  = from[node];
      result.path  = to[node] - from[node] - mean;
      result.speed = result.path.norm() + spread;
      return result;
    }


    /// Two edges on their straight paths.
    template <int dim>
    struct TwoEdges
    {
      std::array<dealii::Point<dim>, 4> begin;
      std::array<dealii::Tensor<1, dim>, 4>
             increments; ///< displacement increments of the nodes, less their mean
      double speed = 0;  ///< bound for the change of the distance

      double
      distance(const double part) const
      {
        auto x = begin;
        for (unsigned int i = 0; i < 4; ++i)
          x[i] += part * increments[i];
        return nearest_of_edges<dim>(x).distance;
      }
    };


    template <int dim>
    TwoEdges<dim>
    two_edges(const std::vector<dealii::Point<dim>> &from,
              const std::vector<dealii::Point<dim>> &to,
              const SharpEdge                       &one,
              const SharpEdge                       &other)
    {
      const std::array<unsigned int, 4> nodes{
        {one.nodes[0], one.nodes[1], other.nodes[0], other.nodes[1]}};
      TwoEdges<dim>          result;
      dealii::Tensor<1, dim> mean;
      for (const unsigned int node : nodes)
        mean += (to[node] - from[node]) / 4;
      for (unsigned int i = 0; i < 4; ++i)
        {
          result.begin[i]      = from[nodes[i]];
          result.increments[i] = to[nodes[i]] - from[nodes[i]] - mean;
        }
      const auto &increments = result.increments;
      result.speed           = std::max(increments[0].norm(), increments[1].norm()) +
                     std::max(increments[2].norm(), increments[3].norm());
      return result;
    }


    /// The part of the paths, at most `limit` [1], on which the distance stays above a fifth of its
    /// first value or, if that is less, above `closest` [m]: by steps that the speed bounds [the
    /// additive advancement of Li, Kaufman, Jiang, ACM Trans. Graph. 40 (2021)].
    template <class Pair>
    double
    part_without_hit(const Pair &pair, const double closest, const double limit)
    {
      constexpr unsigned int most_steps = 10000;
      double                 distance   = pair.distance(0);
      const double           least      = std::min(0.2 * distance, closest);
      double                 part       = 0;
      for (unsigned int step = 0; step < most_steps && distance > 1.05 * least; ++step)
        {
          part += (distance - least) / pair.speed;
          if (!(part < limit))
            return limit;
          distance = pair.distance(part);
        }
      return part;
    }


    /// The part of the paths on which nothing hits a wall.
    template <int dim>
    double
    part_to_walls(const ContactSurfaces<dim>                     &surfaces,
                  const ActivationDistances<dim>                 &distances,
                  const typename ContactSurfaces<dim>::Positions &from,
                  const typename ContactSurfaces<dim>::Positions &to)
    {
      double part = 1;
      for (unsigned int wall = 0; wall < surfaces.walls().size(); ++wall)
        for (unsigned int node = 0; node < surfaces.bodies().n_nodes(); ++node)
          {
            if (!surfaces.meets_wall(node, wall))
              continue;
            const auto  &plane  = surfaces.walls()[wall];
            const double before = (from[node] - plane.point) * plane.normal;
            const double after  = (to[node] - plane.point) * plane.normal;
            const double least  = std::min(0.2 * before, closest(distances.of_wall(node, wall)));
            if (after < least)
              part = std::min(part, (before - least) / (before - after));
          }
      return part;
    }


    /// The part of the paths, at most `limit`, on which no body hits itself.
    template <int dim>
    double
    part_to_itself(const ContactSurfaces<dim>                     &surfaces,
                   const ActivationDistances<dim>                 &distances,
                   const OwnPairsNearby                           &nearby,
                   const typename ContactSurfaces<dim>::Positions &from,
                   const typename ContactSurfaces<dim>::Positions &to,
                   const double                                    limit)
    {
      double part = limit;
      for (const auto &pair : nearby.facets)
        part = part_without_hit(
          node_and_facet<dim>(from, to, pair.first, surfaces.surface().facets()[pair.second]),
          closest(distances.of_own(pair.first)),
          part);
      const auto &edges = surfaces.sharp_edges();
      for (const auto &pair : nearby.edges)
        part = part_without_hit(two_edges<dim>(from, to, edges[pair.first], edges[pair.second]),
                                closest(distances.of_own_edges(pair.first, pair.second)),
                                part);
      return part;
    }
  } // namespace


  template <int dim>
  double
  collision_free_fraction(const ContactSurfaces<dim>                     &surfaces,
                          const ActivationDistances<dim>                 &distances,
                          const OwnPairsNearby                           &nearby,
                          const typename ContactSurfaces<dim>::Positions &from,
                          const typename ContactSurfaces<dim>::Positions &to)
  {
    double       part  = part_to_walls(surfaces, distances, from, to);
    const double least = closest(distances.of_others());
    for_each_near_pair<dim>(
      surfaces, from, to, least, [&](const unsigned int node, const unsigned int facet) {
        const auto pair = node_and_facet<dim>(from, to, node, surfaces.surface().facets()[facet]);
        part            = part_without_hit(pair, least, part);
      });
    for_each_near_edges<dim>(
      surfaces, from, to, least, [&](const unsigned int one, const unsigned int other) {
        const auto &edges = surfaces.sharp_edges();
        part = part_without_hit(two_edges<dim>(from, to, edges[one], edges[other]), least, part);
      });
    return std::max(part_to_itself(surfaces, distances, nearby, from, to, part), 0.);
  }


  template double
  collision_free_fraction(const ContactSurfaces<2> &,
                          const ActivationDistances<2> &,
                          const OwnPairsNearby &,
                          const ContactSurfaces<2>::Positions &,
                          const ContactSurfaces<2>::Positions &);
  template double
  collision_free_fraction(const ContactSurfaces<3> &,
                          const ActivationDistances<3> &,
                          const OwnPairsNearby &,
                          const ContactSurfaces<3>::Positions &,
                          const ContactSurfaces<3>::Positions &);
} // namespace undine
