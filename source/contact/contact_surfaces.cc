// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/contact/contact_surfaces.h>
#include <undine/surface/held_pairs.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    /// Bodies, then obstacles.
    template <int dim>
    Surface<dim>
    side_by_side(const Surface<dim> &bodies, const Obstacles<dim> *obstacles)
    {
      if (!obstacles)
        return bodies;
      const auto               &others = obstacles->surface();
      auto                      facets = bodies.facets();
      auto                      names  = bodies.body_names();
      std::vector<unsigned int> owners;
      for (unsigned int facet = 0; facet < bodies.facets().size(); ++facet)
        owners.push_back(bodies.body(facet));
      for (unsigned int facet = 0; facet < others.facets().size(); ++facet)
        {
          facets.push_back(others.facets()[facet]);
          for (auto &node : facets.back())
            node += bodies.n_nodes();
          owners.push_back(bodies.body_names().size() + others.body(facet));
        }
      names.insert(names.end(), others.body_names().begin(), others.body_names().end());
      return Surface<dim>(bodies.n_nodes() + others.n_nodes(), facets, owners, names);
    }


    /// Is the node of a body that no support moves fixed in all directions?
    template <int dim>
    bool
    stays(const SolidModel<dim>  &solid,
          const BodySurface<dim> &surface,
          const unsigned int      body,
          const unsigned int      node)
    {
      const auto &boundaries = solid.bodies()[body].boundaries;
      const auto &shares     = surface.shares(node);
      return std::none_of(boundaries.begin(),
                          boundaries.end(),
                          [](const auto &boundary) {
                            return boundary.kind == BodyBoundary<dim>::Kind::prescribed_motion;
                          }) &&
             std::all_of(shares.begin(), shares.end(), [&](const auto &share) {
               return std::all_of(share.dofs.begin(), share.dofs.end(), [&](const auto dof) {
                 return solid.all_fixed().is_element(dof);
               });
             });
    }
  } // namespace


  template <int dim>
  ContactSurfaces<dim>::ContactSurfaces(const std::vector<ContactWall<dim>> &walls,
                                        const SolidModel<dim>               &solid,
                                        const Obstacles<dim>                *obstacles)
    : body_surface(solid)
    , obstacles(obstacles)
    , all_facets(side_by_side(body_surface.surface(), obstacles))
    , all_walls(walls)
    , surfaces_of_nodes(all_facets.n_nodes())
  {
    for (unsigned int facet = 0; facet < all_facets.facets().size(); ++facet)
      for (const unsigned int node : all_facets.facets()[facet])
        surfaces_of_nodes[node] = all_facets.body(facet);
    rest_positions = positions(solid.vector(), 0);
    measure();
    all_edges = find_sharp_edges(all_facets, rest_positions);
    find_fixed(solid);
  }


  template <int dim>
  ContactSurfaces<dim>::ContactSurfaces(const ContactSurfaces &all, const BodySurface<dim> &bodies)
    : body_surface(bodies)
    , obstacles(all.obstacles)
    , all_facets(all.all_facets)
    , all_walls(all.all_walls)
    , surfaces_of_nodes(all.surfaces_of_nodes)
    , rest_positions(all.rest_positions)
    , areas(all.areas)
    , all_edges(all.all_edges)
    , fixed(all.fixed)
    , reaching(all.reaching)
    , sliding(all.sliding)
    , grown_together(all.grown_together)
    , least_size(all.least_size)
  {
  }


  template <int dim>
  void
  ContactSurfaces<dim>::measure()
  {
    std::vector<double>       sums(all_facets.body_names().size());
    std::vector<unsigned int> counts(sums.size());
    areas.resize(all_facets.n_nodes());
    for (unsigned int facet = 0; facet < all_facets.facets().size(); ++facet)
      {
        const double area = area_vector(all_facets, facet, rest_positions).norm();
        sums[all_facets.body(facet)] += area;
        ++counts[all_facets.body(facet)];
        for (const unsigned int node : all_facets.facets()[facet])
          areas[node] += area / dim;
      }
    least_size = std::numeric_limits<double>::infinity();
    for (unsigned int body = 0; body < n_bodies(); ++body)
      least_size = std::min(least_size, std::pow(sums[body] / counts[body], 1. / (dim - 1)));
    const auto   first_obstacle = areas.begin() + body_surface.n_nodes();
    const double most           = *std::max_element(areas.begin(), first_obstacle);
    std::for_each(first_obstacle, areas.end(), [&](double &area) { area = std::min(area, most); });
  }


  template <int dim>
  void
  ContactSurfaces<dim>::find_fixed(const SolidModel<dim> &solid)
  {
    const auto held = fixed_nodes(solid, body_surface);
    fixed.assign(n_bodies(), std::vector<bool>(all_walls.size()));
    reaching = sliding = fixed;
    for (unsigned int wall = 0; wall < all_walls.size(); ++wall)
      {
        for (const unsigned int node : held)
          if (rest_gap(node, wall) <= rounding())
            fixed[surfaces_of_nodes[node]][wall] = true;
        for (unsigned int node = 0; node < body_surface.n_nodes(); ++node)
          // Means of corners that are clamped are no evidence of what slides.
          if (body_surface.has_own(node) && rest_gap(node, wall) < -rounding())
            {
              const unsigned int body = surfaces_of_nodes[node];
              reaching[body][wall]    = true;
              if (!stays(solid, body_surface, body, node))
                sliding[body][wall] = true;
            }
      }
    const unsigned int n_surfaces = all_facets.body_names().size();
    grown_together.assign(n_surfaces, std::vector<bool>(n_surfaces));
    for (const auto &[a, b] : held_pairs(all_facets, held, rest_positions, rounding()))
      grown_together[a][b] = grown_together[b][a] = true;
  }


  template <int dim>
  typename ContactSurfaces<dim>::Positions
  ContactSurfaces<dim>::positions(const Vector &displacement, const double time) const
  {
    auto result = body_surface.positions(displacement);
    if (obstacles)
      for (const auto &place : obstacles->positions(time))
        result.push_back(place);
    return result;
  }


  template class ContactSurfaces<2>;
  template class ContactSurfaces<3>;
} // namespace undine
