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


    /// `to` less the mean motion from `from` of each body.
    template <int dim>
    typename ContactSurfaces<dim>::Positions
    without_mean_motion(const ContactSurfaces<dim>                     &surfaces,
                        const typename ContactSurfaces<dim>::Positions &from,
                        const typename ContactSurfaces<dim>::Positions &to)
    {
      auto result = to;
      if (&from == &to)
        return result;
      std::vector<dealii::Tensor<1, dim>> motions(surfaces.n_bodies());
      std::vector<unsigned int>           counts(surfaces.n_bodies());
      for (unsigned int node = 0; node < surfaces.bodies().n_nodes(); ++node)
        {
          motions[surfaces.surface_of_node(node)] += to[node] - from[node];
          ++counts[surfaces.surface_of_node(node)];
        }
      for (unsigned int node = 0; node < surfaces.bodies().n_nodes(); ++node)
        if (const unsigned int body = surfaces.surface_of_node(node); counts[body] > 0)
          result[node] -= motions[body] / counts[body];
      return result;
    }


    /// Parts of surfaces, such as facets: how many there are, and the nodes of each.
    template <class NodesOf>
    struct Parts
    {
      std::size_t size;
      NodesOf     nodes;
    };

    template <class NodesOf>
    Parts(std::size_t, NodesOf) -> Parts<NodesOf>;


    template <class Nodes, class Others>
    bool
    have_common_node(const Nodes &nodes, const Others &others)
    {
      return std::find_first_of(nodes.begin(), nodes.end(), others.begin(), others.end()) !=
             nodes.end();
    }


    /// Calls action(one, other) for parts of one body that come near each other, in ascending
    /// order.
    template <int dim, class Ones, class Others>
    void
    for_each_near_of_own(const ContactSurfaces<dim>                            &surfaces,
                         const typename ContactSurfaces<dim>::Positions        &from,
                         const typename ContactSurfaces<dim>::Positions        &to,
                         const double                                           distance,
                         const Ones                                            &ones,
                         const Others                                          &others,
                         const std::function<void(unsigned int, unsigned int)> &action)
    {
      const auto             end = without_mean_motion(surfaces, from, to);
      std::vector<Leaf<dim>> leaves;
      for (unsigned int other = 0; other < others.size; ++other)
        if (surfaces.is_body(surfaces.surface_of_node(others.nodes(other)[0])))
          leaves.emplace_back(
            Box<dim>(widened(ends_of<dim>(others.nodes(other), from, end), distance)), other);
      if (leaves.empty())
        return;
      const auto                tree = dealii::pack_rtree(leaves);
      std::vector<unsigned int> found;
      for (unsigned int one = 0; one < ones.size; ++one)
        {
          const auto        &nodes   = ones.nodes(one);
          const unsigned int surface = surfaces.surface_of_node(nodes[0]);
          if (!surfaces.is_body(surface))
            continue;
          find<dim>(found, tree, ends_of<dim>(nodes, from, end));
          for (const unsigned int other : found)
            if (surfaces.surface_of_node(others.nodes(other)[0]) == surface)
              action(one, other);
        }
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


  template <int dim>
  void
  for_each_near_own_pair(const ContactSurfaces<dim>                            &surfaces,
                         const typename ContactSurfaces<dim>::Positions        &from,
                         const typename ContactSurfaces<dim>::Positions        &to,
                         const double                                           distance,
                         const std::function<void(unsigned int, unsigned int)> &action)
  {
    const auto &facets = surfaces.surface().facets();
    const Parts nodes{surfaces.bodies().n_nodes(),
                      [](const unsigned int node) { return std::array<unsigned int, 1>{{node}}; }};
    const Parts others{facets.size(), [&](const unsigned int facet) { return facets[facet]; }};
    for_each_near_of_own(surfaces, from, to, distance, nodes, others, action);
  }


  template <int dim>
  void
  for_each_near_own_edges(const ContactSurfaces<dim>                            &surfaces,
                          const typename ContactSurfaces<dim>::Positions        &from,
                          const typename ContactSurfaces<dim>::Positions        &to,
                          const double                                           distance,
                          const std::function<void(unsigned int, unsigned int)> &action)
  {
    const auto &edges = surfaces.sharp_edges();
    const Parts all{edges.size(), [&](const unsigned int edge) { return edges[edge].nodes; }};
    for_each_near_of_own<dim>(surfaces,
                              from,
                              to,
                              distance,
                              all,
                              all,
                              [&](const unsigned int one, const unsigned int other) {
                                if (one < other &&
                                    !have_common_node(edges[one].nodes, edges[other].nodes))
                                  action(one, other);
                              });
  }


  template <int dim>
  void
  for_each_near_own_facets(const ContactSurfaces<dim>                            &surfaces,
                           const typename ContactSurfaces<dim>::Positions        &places,
                           const double                                           distance,
                           const std::function<void(unsigned int, unsigned int)> &action)
  {
    const auto &facets = surfaces.surface().facets();
    const Parts all{facets.size(), [&](const unsigned int facet) { return facets[facet]; }};
    for_each_near_of_own<dim>(surfaces,
                              places,
                              places,
                              distance,
                              all,
                              all,
                              [&](const unsigned int one, const unsigned int other) {
                                if (!have_common_node(facets[one], facets[other]))
                                  action(one, other);
                              });
  }


#define UNDINE_INSTANTIATE(name, dim)                         \
  template void name(const ContactSurfaces<dim> &,            \
                     const std::vector<dealii::Point<dim>> &, \
                     const std::vector<dealii::Point<dim>> &, \
                     double,                                  \
                     const std::function<void(unsigned int, unsigned int)> &);

#define UNDINE_INSTANTIATE_FACETS(dim)                                            \
  template void for_each_near_own_facets(const ContactSurfaces<dim> &,            \
                                         const std::vector<dealii::Point<dim>> &, \
                                         double,                                  \
                                         const std::function<void(unsigned int, unsigned int)> &);

  UNDINE_INSTANTIATE(for_each_near_pair, 2)
  UNDINE_INSTANTIATE(for_each_near_pair, 3)
  UNDINE_INSTANTIATE(for_each_near_edges, 2)
  UNDINE_INSTANTIATE(for_each_near_edges, 3)
  UNDINE_INSTANTIATE(for_each_near_own_pair, 2)
  UNDINE_INSTANTIATE(for_each_near_own_pair, 3)
  UNDINE_INSTANTIATE(for_each_near_own_edges, 2)
  UNDINE_INSTANTIATE(for_each_near_own_edges, 3)
  UNDINE_INSTANTIATE_FACETS(2)
  UNDINE_INSTANTIATE_FACETS(3)
#undef UNDINE_INSTANTIATE
#undef UNDINE_INSTANTIATE_FACETS
} // namespace undine
