// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/disjoint_sets.h>
#include <undine/surface/obstacle_description.h>
#include <undine/surface/obstacles.h>
#include <undine/surface/shape_boundary.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// For each node the number of the closed surface that it belongs to: a hollow obstacle has one
    /// outside and one around each hole.
    template <int dim>
    std::vector<std::size_t>
    find_closed_surfaces(const Surface<dim> &surface)
    {
      DisjointSets joined(surface.n_nodes());
      for (const auto &facet : surface.facets())
        for (const unsigned int node : facet)
          joined.join(facet[0], node);
      std::vector<std::size_t> result;
      for (unsigned int node = 0; node < surface.n_nodes(); ++node)
        result.push_back(joined.smallest(node));
      return result;
    }


    /// int N n dGamma of each node, n out of the solid.
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    node_normals(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions)
    {
      std::vector<dealii::Tensor<1, dim>> result(positions.size());
      for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
        for (const unsigned int node : surface.facets()[facet])
          result[node] += area_vector(surface, facet, positions) / dim;
      return result;
    }


    /// Volume inside each closed surface, known by its lowest node; of a hole negative.
    template <int dim>
    std::vector<double>
    volumes_inside(const Surface<dim>                    &surface,
                   const std::vector<std::size_t>        &closed_surfaces,
                   const std::vector<dealii::Point<dim>> &positions)
    {
      std::vector<double> result(positions.size(), 0.);
      for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
        {
          // Relative to a point of each: a small one far from the origin keeps its digits.
          const unsigned int node  = surface.facets()[facet][0];
          const auto         which = closed_surfaces[node];
          result[which] +=
            (positions[node] - positions[which]) * area_vector(surface, facet, positions) / dim;
        }
      return result;
    }


    /// Add to the velocities along the normals what makes the flux through each closed surface at
    /// `places` the rate at which the volume in it grows from `before` to `after`, `dt` later.
    template <int dim>
    void
    balance_volumes(std::vector<dealii::Tensor<1, dim>>   &velocities,
                    const Surface<dim>                    &surface,
                    const std::vector<dealii::Point<dim>> &places,
                    const std::vector<dealii::Point<dim>> &before,
                    const std::vector<dealii::Point<dim>> &after,
                    const double                           dt)
    {
      const auto          which       = find_closed_surfaces(surface);
      const auto          old_volumes = volumes_inside(surface, which, before);
      const auto          new_volumes = volumes_inside(surface, which, after);
      const auto          normals     = node_normals(surface, places);
      std::vector<double> missing(places.size()), areas(places.size(), 0.);
      for (unsigned int s = 0; s < missing.size(); ++s)
        missing[s] = (new_volumes[s] - old_volumes[s]) / dt;
      for (unsigned int node = 0; node < places.size(); ++node)
        {
          missing[which[node]] -= velocities[node] * normals[node];
          areas[which[node]] += normals[node].norm();
        }
      for (unsigned int node = 0; node < places.size(); ++node)
        if (const double area = normals[node].norm(); area > 0)
          velocities[node] += missing[which[node]] / areas[which[node]] / area * normals[node];
    }
  } // namespace


  template <int dim>
  void
  Obstacles<dim>::declare(const Options &scene)
  {
    read_obstacles<dim>(scene);
  }


  template <int dim>
  Obstacles<dim>::Obstacles(const Options &scene)
  {
    std::vector<typename Surface<dim>::Facet> facets;
    std::vector<unsigned int>                 obstacle_of_facet;
    std::vector<std::string>                  names;
    for (const auto &obstacle : read_obstacles<dim>(scene))
      {
        const auto         boundary = make_shape_boundary(obstacle.description);
        const unsigned int first    = rest_positions.size();
        for (auto facet : boundary.facets)
          {
            for (auto &node : facet)
              node += first;
            facets.push_back(facet);
          }
        obstacle_of_facet.resize(facets.size(), names.size());
        rest_positions.insert(rest_positions.end(), boundary.nodes.begin(), boundary.nodes.end());
        obstacle_of_node.resize(rest_positions.size(), names.size());
        displacements.push_back(obstacle.displacement);
        names.push_back(obstacle.description.name);
      }
    all_facets =
      std::make_unique<const Surface<dim>>(rest_positions.size(), facets, obstacle_of_facet, names);
  }


  template <int dim>
  bool
  Obstacles<dim>::move() const
  {
    return std::any_of(displacements.begin(), displacements.end(), [](const auto &displacement) {
      return !displacement.is_zero();
    });
  }


  template <int dim>
  std::vector<dealii::Point<dim>>
  Obstacles<dim>::positions(const double time) const
  {
    auto result = rest_positions;
    for (unsigned int node = 0; node < result.size(); ++node)
      if (const auto &displacement = displacements[obstacle_of_node[node]]; !displacement.is_zero())
        result[node] += displacement.vector(rest_positions[node], time);
    return result;
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  Obstacles<dim>::velocities(const double time, const double dt) const
  {
    return mean_velocities(time, time, time + dt);
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  Obstacles<dim>::velocities_at(const double time, const double around) const
  {
    return mean_velocities(time, time - around, time + around);
  }


  /// From `begin` to `end`, their flux being balanced at the places of `time` [m/s].
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  Obstacles<dim>::mean_velocities(const double time, const double begin, const double end) const
  {
    const auto                          before = positions(begin), after = positions(end);
    std::vector<dealii::Tensor<1, dim>> result(before.size());
    for (unsigned int node = 0; node < result.size(); ++node)
      result[node] = (after[node] - before[node]) / (end - begin);
    if (move())
      balance_volumes(result, *all_facets, positions(time), before, after, end - begin);
    return result;
  }


  template class Obstacles<2>;
  template class Obstacles<3>;
} // namespace undine
