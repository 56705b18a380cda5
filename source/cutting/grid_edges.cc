// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/cut_flags.h>
#include <undine/cutting/grid_edges.h>

#include <algorithm>

namespace undine
{
  template <int dim>
  void
  GridEdges<dim>::clear()
  {
    slots.clear();
    edges.clear();
    intervals.clear();
    reordered = 0;
  }


  template <int dim>
  void
  GridEdges<dim>::sort_crossings(const Surface<dim>                    &surface,
                                 const std::vector<dealii::Point<dim>> &positions,
                                 const SplitSurface<dim>               &split,
                                 const std::int64_t                     key,
                                 const GridIndex<dim>                  &node,
                                 const unsigned int                     axis)
  {
    order.clear();
    for (int c = split.crossings_on.first(key); c != KeyedLists::none;
         c     = split.crossings_on.next(c))
      order.push_back(c);
    if (order.size() < 2)
      return;
    keys.clear();
    for (const int c : order)
      {
        const auto &crossing = split.crossings[c];
        Sorted      sorted{split.vertices[crossing.vertex].position[axis], {}, c};
        const auto  normal = area_vector(surface, crossing.facet, positions);
        if (normal[axis] != 0)
          {
            unsigned int rank = 0; // the planes of higher axes move farther
            for (unsigned int d = dim; d-- > 0;)
              if (d != axis)
                sorted.shifts[rank++] = -GridPlanes<dim>::shift(node[d]) * normal[d] / normal[axis];
          }
        keys.push_back(sorted);
      }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 0; i < keys.size(); ++i)
      order[i] = keys[i].crossing;
  }


  template <int dim>
  void
  GridEdges<dim>::restore_alternation(Edge                    &edge,
                                      const SplitSurface<dim> &split,
                                      const unsigned int       axis,
                                      const int                start,
                                      const double             width)
  {
    bool alternates = true;
    int  winding    = start;
    for (const int c : order)
      {
        winding += split.crossings[c].sign;
        alternates = alternates && (winding == 0 || winding == 1);
      }
    if (alternates)
      return;
    const auto sorted = order;
    entering.clear();
    leaving.clear();
    for (const int c : order)
      (split.crossings[c].sign > 0 ? entering : leaving).push_back(c);
    auto next_in = entering.begin(), next_out = leaving.begin();
    winding = start;
    for (int &c : order)
      {
        c       = winding == 0 ? *next_in++ : *next_out++;
        winding = 1 - winding;
      }
    const auto position = [&](const int c) {
      return split.vertices[split.crossings[c].vertex].position[axis];
    };
    for (std::size_t i = 0; i + 1 < order.size(); ++i)
      if (position(order[i]) - position(order[i + 1]) > reported_inversion * width)
        edge.flags |= cut_order;
    if (edge.flags & cut_order)
      order = sorted; // bodies overlap: what lies outside all of them is fluid
    else
      ++reordered;
  }


  template <int dim>
  typename GridEdges<dim>::Edge
  GridEdges<dim>::edge(const GridBlock<dim>                  &block,
                       const Surface<dim>                    &surface,
                       const std::vector<dealii::Point<dim>> &positions,
                       const NodeWindings<dim>               &windings,
                       SplitSurface<dim>                     &split,
                       const GridIndex<dim>                  &node,
                       const unsigned int                     axis)
  {
    const std::int64_t key  = block.key(node, axis);
    const int          slot = slots.add(key);
    if (slot < static_cast<int>(edges.size()))
      return edges[slot];
    Edge               edge;
    const std::int64_t first = block.key(node), last = block.key(moved(node, axis, 1));
    sort_crossings(surface, positions, split, key, node, axis);
    int winding = windings[first], end = winding;
    for (const int c : order)
      end += split.crossings[c].sign;
    const auto possible = [](const int w) { return w == 0 || w == 1; };
    if (end != windings[last] || !possible(winding) || !possible(end))
      edge.flags |= cut_winding;
    else if (order.size() > 1)
      restore_alternation(edge, split, axis, winding, block.planes().width(axis, node[axis]));

    edge.begin   = intervals.size();
    int previous = -1 - static_cast<int>(first);
    for (const int c : order)
      {
        const auto &crossing = split.crossings[c];
        if (winding == 0)
          intervals.push_back({previous, crossing.vertex, split.new_edge()});
        winding += crossing.sign;
        previous = crossing.vertex;
      }
    if (winding == 0)
      intervals.push_back({previous, -1 - static_cast<int>(last), split.new_edge()});
    edge.end = intervals.size();
    edges.push_back(edge);
    return edge;
  }


  template class GridEdges<2>;
  template class GridEdges<3>;
} // namespace undine
