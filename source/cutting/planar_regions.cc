// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/cut_flags.h>
#include <undine/cutting/planar_regions.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// Add what an edge contributes to area, moments and bounding box by Green's theorem.
    void
    add_edge(PlanarRegion &region, const PlanarEdge &edge)
    {
      const double cross = edge.start[0] * edge.end[1] - edge.end[0] * edge.start[1];
      region.area += cross / 2;
      for (unsigned int d = 0; d < 2; ++d)
        {
          region.moment[d] += (edge.start[d] + edge.end[d]) * cross / 6;
          region.lower[d] = std::min(region.lower[d], edge.start[d]);
          region.upper[d] = std::max(region.upper[d], edge.start[d]);
        }
    }


    void
    add_region(PlanarRegion &region, const PlanarRegion &part)
    {
      region.area += part.area;
      for (unsigned int d = 0; d < 2; ++d)
        {
          region.moment[d] += part.moment[d];
          region.lower[d] = std::min(region.lower[d], part.lower[d]);
          region.upper[d] = std::max(region.upper[d], part.upper[d]);
        }
    }
  } // namespace


  unsigned int
  PlanarProblem::find_regions(std::vector<PlanarEdge> &edges,
                              const int                begin,
                              const int                end,
                              const double             rounding)
  {
    unsigned int flags = link(edges, begin, end);
    flags |= follow_loops(edges, begin, end, rounding);
    flags |= attach_holes(edges, begin, end);
    flags |= number_regions();
    for (int i = begin; i < end; ++i)
      edges[i].region = loops[edges[i].region].number;
    return flags;
  }


  unsigned int
  PlanarProblem::link(const std::vector<PlanarEdge> &edges, const int begin, const int end)
  {
    const int    n     = end - begin;
    unsigned int flags = 0;
    order.resize(n);
    successors.assign(n, -1);
    for (int i = 0; i < n; ++i)
      order[i] = i;
    const auto start = [&](const int i) { return edges[begin + i].from; };
    std::sort(order.begin(), order.end(), [&](const int i, const int j) {
      return start(i) != start(j) ? start(i) < start(j) : i < j;
    });
    for (int i = 0; i < n; ++i)
      {
        const int  vertex = edges[begin + i].to;
        const auto it =
          std::lower_bound(order.begin(), order.end(), vertex, [&](const int j, const int v) {
            return start(j) < v;
          });
        if (it == order.end() || start(*it) != vertex ||
            (it + 1 != order.end() && start(*(it + 1)) == vertex))
          flags |= cut_loop;
        else
          successors[i] = *it;
      }
    return flags;
  }


  unsigned int
  PlanarProblem::follow_loops(std::vector<PlanarEdge> &edges,
                              const int                begin,
                              const int                end,
                              const double             rounding)
  {
    unsigned int flags = 0;
    loops.clear();
    for (int i = begin; i < end; ++i)
      edges[i].region = -1;
    for (int i = begin; i < end; ++i)
      {
        if (edges[i].region >= 0)
          continue;
        Loop loop{{}, LoopKind::debris, -1, -1};
        bool on_rim = false;
        int  at     = i - begin;
        while (at >= 0 && edges[begin + at].region < 0)
          {
            auto &edge  = edges[begin + at];
            edge.region = loops.size();
            add_edge(loop.region, edge);
            on_rim = on_rim || edge.on_rim;
            at     = successors[at];
          }
        if (at != i - begin)
          flags |= cut_loop;
        if (on_rim || loop.region.area > rounding)
          loop.kind = LoopKind::outer;
        else if (loop.region.area < -rounding)
          loop.kind = LoopKind::hole;
        loop.region.debris = loop.kind == LoopKind::debris;
        loops.push_back(loop);
      }
    return flags;
  }


  unsigned int
  PlanarProblem::attach_holes(const std::vector<PlanarEdge> &edges, const int begin, const int end)
  {
    unsigned int flags   = 0;
    int          n_outer = 0, outer = -1;
    for (std::size_t l = 0; l < loops.size(); ++l)
      if (loops[l].kind == LoopKind::outer)
        {
          ++n_outer;
          outer = l;
        }
    for (std::size_t l = 0; l < loops.size(); ++l)
      if (loops[l].kind == LoopKind::hole)
        {
          loops[l].enclosing = n_outer > 1 ? enclosing_loop(edges, begin, end, l) : outer;
          if (loops[l].enclosing < 0)
            flags |= cut_nesting;
        }
    return flags;
  }


  unsigned int
  PlanarProblem::number_regions()
  {
    unsigned int flags = 0;
    all_regions.clear();
    const auto add = [&](Loop &loop) {
      loop.number = all_regions.size();
      all_regions.emplace_back();
      all_regions.back().debris = loop.region.debris;
    };
    for (auto &loop : loops)
      if (loop.enclosing < 0)
        add(loop);
    for (std::size_t l = 0; l < loops.size(); ++l)
      if (loops[l].enclosing >= 0)
        {
          // Holes may lie in holes' loops; more steps than loops means that they go in circles.
          std::size_t at = l, steps = 0;
          while (loops[at].enclosing >= 0 && steps++ < loops.size())
            at = loops[at].enclosing;
          if (loops[at].number < 0)
            {
              flags |= cut_nesting;
              loops[at].enclosing = -1;
              add(loops[at]);
            }
          loops[l].number = loops[at].number;
        }
    for (const auto &loop : loops)
      add_region(all_regions[loop.number], loop.region);
    return flags;
  }


  int
  PlanarProblem::enclosing_loop(const std::vector<PlanarEdge> &edges,
                                const int                      begin,
                                const int                      end,
                                const int                      hole) const
  {
    // Start from the middles of edges with fluid on the right, the farthest right first.
    std::vector<int> starts;
    for (int i = begin; i < end; ++i)
      if (edges[i].region == hole && edges[i].end[1] < edges[i].start[1])
        starts.push_back(i);
    std::sort(starts.begin(), starts.end(), [&](const int i, const int j) {
      const double a = edges[i].start[0] + edges[i].end[0];
      const double b = edges[j].start[0] + edges[j].end[0];
      return a != b ? a > b : i < j;
    });
    for (const int i : starts)
      {
        const auto                 &edge = edges[i];
        const std::array<double, 2> middle{
          {(edge.start[0] + edge.end[0]) / 2, (edge.start[1] + edge.end[1]) / 2}};
        if (!(middle[1] < edge.start[1]))
          continue;
        const int hit = first_hit(edges, begin, end, middle, [&](const PlanarEdge &other) {
          return loops[other.region].kind != LoopKind::debris;
        });
        if (hit >= 0 && edges[hit].region != hole)
          return edges[hit].region;
      }
    return -1;
  }
} // namespace undine
