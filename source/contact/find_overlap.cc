// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/point_text.h>
#include <undine/contact/contact_boxes.h>
#include <undine/contact/find_overlap.h>
#include <undine/surface/held_pairs.h>
#include <undine/surface/simplex.h>
#include <undine/surface/surface_distance.h>

#include <deal.II/base/bounding_box.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

namespace undine
{
  namespace
  {
    template <int dim>
    std::string
    wall_complaint(const ContactSurfaces<dim>                     &surfaces,
                   const typename ContactSurfaces<dim>::Positions &places)
    {
      for (unsigned int node = 0; node < surfaces.bodies().n_nodes(); ++node)
        for (unsigned int wall = 0; wall < surfaces.walls().size(); ++wall)
          {
            const auto        &plane = surfaces.walls()[wall];
            const unsigned int body  = surfaces.surface_of_node(node);
            if (surfaces.meets_wall(node, wall) &&
                !((places[node] - plane.point) * plane.normal > surfaces.rounding()))
              return fmt::format("body '{}' is not on the free side of wall '{}' at {}",
                                 surfaces.surface().body_names()[body],
                                 plane.name,
                                 text_of(places[node]));
          }
      return "";
    }


    template <int dim>
    dealii::BoundingBox<dim>
    box_of(const std::vector<unsigned int> &nodes, const std::vector<dealii::Point<dim>> &places)
    {
      std::vector<dealii::Point<dim>> of_nodes;
      for (const unsigned int node : nodes)
        of_nodes.push_back(places[node]);
      return dealii::BoundingBox<dim>(of_nodes);
    }


    /// Does the segment between two nodes cross the facet? Not if both are as far from its plane,
    /// to `rounding` [m]: facets of one face lie in one plane only as far as places are not
    /// rounded.
    template <int dim>
    bool
    cross(const std::vector<dealii::Point<dim>> &places,
          const unsigned int                     begin,
          const unsigned int                     end,
          const typename Surface<dim>::Facet    &facet,
          const double                           rounding)
    {
      std::array<dealii::Point<dim>, dim> nodes;
      for (unsigned int k = 0; k < dim; ++k)
        nodes[k] = places[facet[k]];
      const auto area = area_vector(nodes);
      if (!(std::abs((places[end] - places[begin]) * area) > rounding * area.norm()))
        return false;
      dealii::Tensor<2, dim> matrix; // columns: the segment backwards, edges of the facet
      const auto             set = [&](const unsigned int column, const auto &vector) {
        for (unsigned int axis = 0; axis < dim; ++axis)
          matrix[axis][column] = vector[axis];
      };
      set(0, places[begin] - places[end]);
      for (unsigned int k = 1; k < dim; ++k)
        set(k, places[facet[k]] - places[facet[0]]);
      const auto parts = invert(matrix) * (places[begin] - places[facet[0]]);
      double     sum   = 0;
      bool       inner = parts[0] >= 0 && parts[0] <= 1;
      for (unsigned int k = 1; k < dim; ++k)
        {
          inner = inner && parts[k] >= 0;
          sum += parts[k];
        }
      return inner && sum <= 1;
    }


    /// Whether a body touches itself or passes through itself.
    template <int dim>
    std::string
    own_complaint(const ContactSurfaces<dim>                     &surfaces,
                  const ActivationDistances<dim>                 &distances,
                  const typename ContactSurfaces<dim>::Positions &places)
    {
      std::string result;
      const auto  complain = [&](const unsigned int node, const std::string &what) {
        result = fmt::format("'{}' {} at {}",
                             surfaces.surface().body_names()[surfaces.surface_of_node(node)],
                             what,
                             text_of(places[node]));
      };
      for (unsigned int node = 0; node < surfaces.bodies().n_nodes() && result.empty(); ++node)
        if (distances.of_own(node) <= surfaces.rounding())
          complain(node, "touches itself");
      const auto &facets = surfaces.surface().facets();
      for_each_near_own_facets<dim>(
        surfaces, places, 0, [&](const unsigned int one, const unsigned int other) {
          for (unsigned int k = 0; k < dim && result.empty(); ++k)
            for (unsigned int l = 0; l < k; ++l)
              if (cross<dim>(
                    places, facets[one][k], facets[one][l], facets[other], surfaces.rounding()))
                complain(facets[one][k], "passes through itself");
        });
      return result;
    }
  } // namespace


  template <int dim>
  std::optional<NodeInSurface>
  find_surfaces_that_overlap(const ContactSurfaces<dim>                            &surfaces,
                             const typename ContactSurfaces<dim>::Positions        &places,
                             const double                                           depth,
                             const std::function<bool(unsigned int, unsigned int)> &counts)
  {
    std::vector<std::vector<unsigned int>> nodes(surfaces.surface().body_names().size());
    for (unsigned int node = 0; node < places.size(); ++node)
      nodes[surfaces.surface_of_node(node)].push_back(node);
    for (unsigned int surface = 0; surface < nodes.size(); ++surface)
      {
        std::vector<unsigned int> inside; // of the box
        auto                      box = box_of(nodes[surface], places);
        box.extend(std::max(-depth, 0.));
        for (unsigned int other = 0; other < nodes.size(); ++other)
          if (other != surface && counts(surface, other))
            std::copy_if(nodes[other].begin(),
                         nodes[other].end(),
                         std::back_inserter(inside),
                         [&](const unsigned int node) { return box.point_inside(places[node]); });
        if (inside.empty())
          continue;
        const SurfaceDistance<dim> distance(one_surface(surfaces.surface(), surface), places);
        for (const unsigned int node : inside)
          if (!(distance.nearest(places[node]).distance > -depth))
            return NodeInSurface{node, surface};
      }
    return {};
  }


  template <int dim>
  std::string
  find_overlap(const ContactSurfaces<dim>                     &surfaces,
               const ActivationDistances<dim>                 &distances,
               const typename ContactSurfaces<dim>::Positions &places)
  {
    std::string complaint = wall_complaint(surfaces, places);
    if (!complaint.empty())
      return complaint;
    const auto overlap =
      find_surfaces_that_overlap<dim>(surfaces,
                                      places,
                                      -surfaces.rounding(),
                                      [&](const unsigned int surface, const unsigned int other) {
                                        return surfaces.meet(surface, other);
                                      });
    if (overlap)
      return fmt::format("'{}' overlaps '{}' at {}",
                         surfaces.surface().body_names()[surfaces.surface_of_node(overlap->node)],
                         surfaces.surface().body_names()[overlap->surface],
                         text_of(places[overlap->node]));
    return own_complaint(surfaces, distances, places);
  }


  template std::optional<NodeInSurface>
  find_surfaces_that_overlap(const ContactSurfaces<2> &,
                             const ContactSurfaces<2>::Positions &,
                             double,
                             const std::function<bool(unsigned int, unsigned int)> &);
  template std::optional<NodeInSurface>
  find_surfaces_that_overlap(const ContactSurfaces<3> &,
                             const ContactSurfaces<3>::Positions &,
                             double,
                             const std::function<bool(unsigned int, unsigned int)> &);
  template std::string
  find_overlap(const ContactSurfaces<2> &,
               const ActivationDistances<2> &,
               const ContactSurfaces<2>::Positions &);
  template std::string
  find_overlap(const ContactSurfaces<3> &,
               const ActivationDistances<3> &,
               const ContactSurfaces<3>::Positions &);
} // namespace undine
