// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/contact/contact_boxes.h>

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


    /// Boxes around the paths of all nodes of each surface.
    template <int dim>
    std::vector<Ends<dim>>
    boxes_of_surfaces(const ContactSurfaces<dim>                     &surfaces,
                      const typename ContactSurfaces<dim>::Positions &from,
                      const typename ContactSurfaces<dim>::Positions &to)
    {
      std::vector<Ends<dim>> result(surfaces.surface().body_names().size(), nothing<dim>());
      for (unsigned int node = 0; node < from.size(); ++node)
        {
          include(result[surfaces.surface_of_node(node)], from[node]);
          include(result[surfaces.surface_of_node(node)], to[node]);
        }
      return result;
    }


    /// The box around the paths of some nodes.
    template <int dim, class Nodes>
    Ends<dim>
    ends_of(const Nodes                                    &nodes,
            const typename ContactSurfaces<dim>::Positions &from,
            const typename ContactSurfaces<dim>::Positions &to)
    {
      auto result = nothing<dim>();
      for (const unsigned int node : nodes)
        {
          include(result, from[node]);
          include(result, to[node]);
        }
      return result;
    }


    /// For each surface the boxes of the others that it may meet.
    template <int dim>
    class Neighbours
    {
    public:
      Neighbours(const ContactSurfaces<dim>   &surfaces,
                 const std::vector<Ends<dim>> &boxes,
                 const double                  distance)
        : boxes(boxes)
        , others(boxes.size())
      {
        for (unsigned int a = 0; a < boxes.size(); ++a)
          for (unsigned int b = 0; b < boxes.size(); ++b)
            if (surfaces.meet(a, b) && meet(widened(boxes[a], distance), boxes[b]))
              others[a].push_back(b);
      }

      bool
      has_any(const unsigned int surface) const
      {
        return !others[surface].empty();
      }

      bool
      are_near(const Ends<dim> &ends, const unsigned int surface) const
      {
        return std::any_of(others[surface].begin(), others[surface].end(), [&](const auto other) {
          return meet(ends, boxes[other]);
        });
      }

    private:
      const std::vector<Ends<dim>>           boxes;
      std::vector<std::vector<unsigned int>> others;
    };


    template <int dim>
    using Leaf = std::pair<Box<dim>, unsigned int>;

    template <int dim>
    using Tree = decltype(dealii::pack_rtree(std::vector<Leaf<dim>>()));


    /// The leaves that a box meets, in ascending order.
    template <int dim>
    void
    find(std::vector<unsigned int> &found, const Tree<dim> &tree, const Ends<dim> &ends)
    {
      std::vector<Leaf<dim>> leaves;
      tree.query(index::intersects(Box<dim>(ends)), std::back_inserter(leaves));
      found.clear();
      for (const auto &leaf : leaves)
        found.push_back(leaf.second);
      std::sort(found.begin(), found.end());
    }
  } // namespace


  template <int dim>
  void
  for_each_near_pair(const ContactSurfaces<dim>                            &surfaces,
                     const typename ContactSurfaces<dim>::Positions        &from,
                     const typename ContactSurfaces<dim>::Positions        &to,
                     const double                                           distance,
                     const std::function<void(unsigned int, unsigned int)> &action)
  {
    const Neighbours<dim>  neighbours(surfaces, boxes_of_surfaces(surfaces, from, to), distance);
    const auto            &facets = surfaces.surface().facets();
    std::vector<Leaf<dim>> leaves;
    for (unsigned int facet = 0; facet < facets.size(); ++facet)
      {
        const unsigned int surface = surfaces.surface().body(facet);
        if (!neighbours.has_any(surface))
          continue;
        const auto ends = widened(ends_of<dim>(facets[facet], from, to), distance);
        if (neighbours.are_near(ends, surface))
          leaves.emplace_back(Box<dim>(ends), facet);
      }
    if (leaves.empty())
      return;
    const auto                tree = dealii::pack_rtree(leaves);
    std::vector<unsigned int> found;
    for (unsigned int node = 0; node < from.size(); ++node)
      {
        const unsigned int surface = surfaces.surface_of_node(node);
        if (!neighbours.has_any(surface))
          continue;
        const auto ends = ends_of<dim>(std::array<unsigned int, 1>{{node}}, from, to);
        if (!neighbours.are_near(widened(ends, distance), surface))
          continue;
        find<dim>(found, tree, ends);
        for (const unsigned int facet : found)
          if (surfaces.meet(surface, surfaces.surface().body(facet)))
            action(node, facet);
      }
  }


  template <int dim>
  void
  for_each_near_edges(const ContactSurfaces<dim>                            &surfaces,
                      const typename ContactSurfaces<dim>::Positions        &from,
                      const typename ContactSurfaces<dim>::Positions        &to,
                      const double                                           distance,
                      const std::function<void(unsigned int, unsigned int)> &action)
  {
    const auto &edges = surfaces.sharp_edges();
    if (edges.empty())
      return;
    const Neighbours<dim>  neighbours(surfaces, boxes_of_surfaces(surfaces, from, to), distance);
    std::vector<Leaf<dim>> leaves;
    for (unsigned int edge = 0; edge < edges.size(); ++edge)
      {
        const unsigned int surface = edges[edge].surface;
        if (!neighbours.has_any(surface))
          continue;
        const auto ends = widened(ends_of<dim>(edges[edge].nodes, from, to), distance);
        if (neighbours.are_near(ends, surface))
          leaves.emplace_back(Box<dim>(ends), edge);
      }
    if (leaves.empty())
      return;
    const auto                tree = dealii::pack_rtree(leaves);
    std::vector<unsigned int> found;
    for (const auto &leaf : leaves)
      {
        const auto &edge = edges[leaf.second];
        find<dim>(found, tree, ends_of<dim>(edge.nodes, from, to));
        for (const unsigned int other : found)
          if (leaf.second < other && surfaces.meet(edge.surface, edges[other].surface))
            action(leaf.second, other);
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
  template void
  for_each_near_edges(const ContactSurfaces<2> &,
                      const std::vector<dealii::Point<2>> &,
                      const std::vector<dealii::Point<2>> &,
                      double,
                      const std::function<void(unsigned int, unsigned int)> &);
  template void
  for_each_near_edges(const ContactSurfaces<3> &,
                      const std::vector<dealii::Point<3>> &,
                      const std::vector<dealii::Point<3>> &,
                      double,
                      const std::function<void(unsigned int, unsigned int)> &);
} // namespace undine
