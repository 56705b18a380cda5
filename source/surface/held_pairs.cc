// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/held_pairs.h>
#include <undine/surface/surface_distance.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace undine
{
  template <int dim>
  Surface<dim>
  one_surface(const Surface<dim> &all, const unsigned int surface)
  {
    std::vector<typename Surface<dim>::Facet> facets;
    for (unsigned int facet = 0; facet < all.facets().size(); ++facet)
      if (all.body(facet) == surface)
        facets.push_back(all.facets()[facet]);
    const std::vector<unsigned int> owners(facets.size(), 0);
    return Surface<dim>(all.n_nodes(), facets, owners, {all.body_names()[surface]});
  }


  template <int dim>
  std::vector<unsigned int>
  fixed_nodes(const SolidModel<dim> &solid, const BodySurface<dim> &bodies)
  {
    std::vector<unsigned int> result;
    for (unsigned int node = 0; node < bodies.n_nodes(); ++node)
      {
        const auto is_fixed = [&](const auto &share) {
          return std::any_of(share.dofs.begin(), share.dofs.end(), [&](const auto dof) {
            return solid.all_fixed().is_element(dof);
          });
        };
        const auto &shares = bodies.shares(node);
        if (bodies.moves(node) && std::all_of(shares.begin(), shares.end(), is_fixed))
          result.push_back(node);
      }
    return result;
  }


  template <int dim>
  double
  rounding_of_places(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions)
  {
    double sum = 0;
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      sum += area_vector(surface, facet, positions).norm();
    return 1e-9 * std::pow(sum / surface.facets().size(), 1. / (dim - 1));
  }


  template <int dim>
  std::vector<PairOfSurfaces>
  held_pairs(const Surface<dim>                    &all,
             const std::vector<unsigned int>       &fixed,
             const std::vector<dealii::Point<dim>> &rest,
             const double                           reach)
  {
    if (fixed.empty())
      return {};
    std::vector<unsigned int> surface_of_node(all.n_nodes());
    for (unsigned int facet = 0; facet < all.facets().size(); ++facet)
      for (const unsigned int node : all.facets()[facet])
        surface_of_node[node] = all.body(facet);
    std::set<PairOfSurfaces> result;
    for (unsigned int surface = 0; surface < all.body_names().size(); ++surface)
      {
        const SurfaceDistance<dim> distance(one_surface(all, surface), rest);
        const auto                 box = distance.box();
        for (const unsigned int node : fixed)
          {
            const unsigned int   body = surface_of_node[node];
            const PairOfSurfaces pair{{std::min(body, surface), std::max(body, surface)}};
            if (body != surface && result.count(pair) == 0 && box.point_inside(rest[node], 1e-9) &&
                distance.nearest(rest[node]).distance <= reach)
              result.insert(pair);
          }
      }
    return {result.begin(), result.end()};
  }


#define UNDINE_INSTANTIATE(dim)                                                                     \
  template double                      rounding_of_places(const Surface<dim> &,                     \
                                                          const std::vector<dealii::Point<dim>> &); \
  template Surface<dim>                one_surface(const Surface<dim> &, unsigned int);             \
  template std::vector<unsigned int>   fixed_nodes(const SolidModel<dim> &,                         \
                                                   const BodySurface<dim> &);                       \
  template std::vector<PairOfSurfaces> held_pairs(const Surface<dim> &,                             \
                                                  const std::vector<unsigned int> &,                \
                                                  const std::vector<dealii::Point<dim>> &,          \
                                                  double);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
