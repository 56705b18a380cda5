// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/component_finder.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  int
  ComponentFinder<3>::surroundings(const CutCells<3>     &cut,
                                   const CutWorkspace<3> &work,
                                   const int              island)
  {
    // Start from fragments with fluid above them along axis 0, the highest first.
    std::vector<std::pair<double, int>> starts;
    const int                           first_fragment = cut.cells.back().first_fragment;
    for (int e = 0; e < first_element[0]; ++e)
      if (root(e) == island && cut.fragments[first_fragment + e].area_vector[0] < 0)
        starts.emplace_back(-elements[e].sums.upper[0], e);
    std::sort(starts.begin(), starts.end());

    const auto  &cell     = cut.cells.back().index;
    const int    upper    = face_numbers[1];
    const auto  &face     = cut.faces[upper];
    const double rounding = cut.block.rounding(cell) * cut.block.face_area(0, cell);
    for (const auto &from : starts)
      {
        const auto      &fragment = work.split.fragments[fragments[from.second]];
        dealii::Point<3> start;
        for (int i = fragment.begin; i < fragment.end; ++i)
          start += (local(work.split.corners[i], work) - dealii::Point<3>()) /
                   (fragment.end - fragment.begin);
        const int hit = first_fragment_hit(cut, work, start);
        if (hit == island)
          continue;
        if (hit >= 0)
          return hit;
        const auto &record = work.face_records[upper];
        const int   edge =
          first_hit(work.planar_edges,
                    record.first_planar,
                    record.end_planar,
                    {{start[1], start[2]}},
                    [&](const PlanarEdge &e) {
                      return std::abs(cut.pieces[face.first_piece + e.region].area) > rounding;
                    });
        if (edge >= 0)
          return root(first_element[1] + work.planar_edges[edge].region);
      }
    return -1;
  }


  int
  ComponentFinder<3>::first_fragment_hit(const CutCells<3>      &cut,
                                         const CutWorkspace<3>  &work,
                                         const dealii::Point<3> &start)
  {
    int       hit            = -1;
    double    best           = std::numeric_limits<double>::max();
    const int first_fragment = cut.cells.back().first_fragment;
    for (int e = 0; e < first_element[0]; ++e)
      {
        const auto &fragment = work.split.fragments[fragments[e]];
        const auto &normal   = cut.fragments[first_fragment + e].area_vector;
        if (!(normal[0] > 0) || elements[root(e)].debris)
          continue;
        bool inside = false;
        for (int i = fragment.begin; i < fragment.end; ++i)
          {
            // The edge has the same direction for both fragments that meet in it.
            auto a = work.split.corners[i];
            auto b = work.split.corners[i + 1 < fragment.end ? i + 1 : fragment.begin];
            if (a.vertex > b.vertex)
              std::swap(a, b);
            const auto p = local(a, work), q = local(b, work);
            if ((p[2] <= start[2]) != (q[2] <= start[2]) &&
                p[1] + (start[2] - p[2]) / (q[2] - p[2]) * (q[1] - p[1]) > start[1])
              inside = !inside;
          }
        if (!inside)
          continue;
        const auto   corner = local(work.split.corners[fragment.begin], work);
        const double x =
          corner[0] -
          (normal[1] * (start[1] - corner[1]) + normal[2] * (start[2] - corner[2])) / normal[0];
        if (x >= start[0] && x < best)
          {
            best = x;
            hit  = root(e);
          }
      }
    return hit;
  }
} // namespace undine
