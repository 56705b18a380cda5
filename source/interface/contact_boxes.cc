// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/interface/contact_boxes.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>

namespace undine
{
  namespace
  {
    namespace index = boost::geometry::index;

    template <int dim>
    using Box = dealii::BoundingBox<dim>;

    template <int dim>
    using Ends = std::pair<dealii::Point<dim>, dealii::Point<dim>>;


    template <int dim>
    Ends<dim>
    nothing()
    {
      Ends<dim> ends;
      for (unsigned int d = 0; d < dim; ++d)
        {
          ends.first[d]  = std::numeric_limits<double>::max();
          ends.second[d] = std::numeric_limits<double>::lowest();
        }
      return ends;
    }


    template <int dim>
    void
    include(Ends<dim> &ends, const dealii::Point<dim> &place)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          ends.first[d]  = std::min(ends.first[d], place[d]);
          ends.second[d] = std::max(ends.second[d], place[d]);
        }
    }


    /// Wider by `distance` on all sides.
    template <int dim>
    Ends<dim>
    widened(Ends<dim> ends, const double distance)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          ends.first[d] -= distance;
          ends.second[d] += distance;
        }
      return ends;
    }


    template <int dim>
    bool
    meet(const Ends<dim> &a, const Ends<dim> &b)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (a.first[d] > b.second[d] || b.first[d] > a.second[d])
          return false;
      return true;
    }


    /// Around all ways of the nodes of each surface.
    template <int dim>
    std::vector<Ends<dim>>
    boxes_of_surfaces(const ContactSurfaces<dim>                  &surfaces,
                      const typename ContactSurfaces<dim>::Places &from,
                      const typename ContactSurfaces<dim>::Places &to)
    {
      std::vector<Ends<dim>> result(surfaces.surface().body_names().size(), nothing<dim>());
      for (unsigned int node = 0; node < from.size(); ++node)
        {
          include(result[surfaces.surface_of_node(node)], from[node]);
          include(result[surfaces.surface_of_node(node)], to[node]);
        }
      return result;
    }


    /// For each surface the others that it may meet.
    template <int dim>
    std::vector<std::vector<unsigned int>>
    neighbours(const ContactSurfaces<dim>   &surfaces,
               const std::vector<Ends<dim>> &boxes,
               const double                  distance)
    {
      std::vector<std::vector<unsigned int>> result(boxes.size());
      for (unsigned int a = 0; a < boxes.size(); ++a)
        for (unsigned int b = 0; b < boxes.size(); ++b)
          if (surfaces.meet(a, b) && meet(widened(boxes[a], distance), boxes[b]))
            result[a].push_back(b);
      return result;
    }
  } // namespace


  template <int dim>
  void
  for_each_near_pair(const ContactSurfaces<dim>                            &surfaces,
                     const typename ContactSurfaces<dim>::Places           &from,
                     const typename ContactSurfaces<dim>::Places           &to,
                     const double                                           distance,
                     const std::function<void(unsigned int, unsigned int)> &action)
  {
    const auto boxes  = boxes_of_surfaces(surfaces, from, to);
    const auto others = neighbours(surfaces, boxes, distance);
    const auto near   = [&](const Ends<dim> &ends, const unsigned int surface) {
      return std::any_of(others[surface].begin(), others[surface].end(), [&](const auto other) {
        return meet(ends, boxes[other]);
      });
    };

    const auto                                    &facets = surfaces.surface().facets();
    std::vector<std::pair<Box<dim>, unsigned int>> leaves;
    for (unsigned int facet = 0; facet < facets.size(); ++facet)
      {
        const unsigned int surface = surfaces.surface().body(facet);
        if (others[surface].empty())
          continue;
        auto ends = nothing<dim>();
        for (const unsigned int node : facets[facet])
          {
            include(ends, from[node]);
            include(ends, to[node]);
          }
        ends = widened(ends, distance);
        if (near(ends, surface))
          leaves.emplace_back(Box<dim>(ends), facet);
      }
    if (leaves.empty())
      return;
    const auto                                     tree = dealii::pack_rtree(leaves);
    std::vector<std::pair<Box<dim>, unsigned int>> found;
    for (unsigned int node = 0; node < from.size(); ++node)
      {
        const unsigned int surface = surfaces.surface_of_node(node);
        auto               ends    = nothing<dim>();
        include(ends, from[node]);
        include(ends, to[node]);
        if (others[surface].empty() || !near(widened(ends, distance), surface))
          continue;
        found.clear();
        tree.query(index::intersects(Box<dim>(ends)), std::back_inserter(found));
        std::sort(found.begin(), found.end(), [](const auto &a, const auto &b) {
          return a.second < b.second;
        });
        for (const auto &leaf : found)
          {
            if (surfaces.meet(surface, surfaces.surface().body(leaf.second)))
              action(node, leaf.second);
          }
      }
  }


  template void
  for_each_near_pair(const ContactSurfaces<2> &,
                     const std::vector<dealii::Point<2>> &,
                     const std::vector<dealii::Point<2>> &,
                     double,
                     const std::function<void(unsigned int, unsigned int)> &);
  template void
  for_each_near_pair(const ContactSurfaces<3> &,
                     const std::vector<dealii::Point<3>> &,
                     const std::vector<dealii::Point<3>> &,
                     double,
                     const std::function<void(unsigned int, unsigned int)> &);
} // namespace undine
