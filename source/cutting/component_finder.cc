// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/chord_splitter.h>
#include <undine/cutting/component_finder.h>
#include <undine/cutting/cut_flags.h>
#include <undine/cutting/fragment_integrals.h>
#include <undine/surface/simplex.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  void
  ComponentFinder<2>::add_fragments(CutCells<2>            &cut,
                                    const CutWorkspace<2>  &work,
                                    const PlacedSurface<2> &placed,
                                    const int               first_component) const
  {
    const auto &split = work.split;
    int         edge  = 0;
    for (int c = split.chords_on.first(cut.block.key(cut.cells.back().index, 0));
         c != KeyedLists::none;
         c = split.chords_on.next(c), ++edge)
      {
        // The chord runs against its facet.
        const auto &chord = split.chords[c];
        const auto &start = split.vertices[chord.to], &end = split.vertices[chord.from];
        const auto  a = barycentric(placed.surface, chord.facet, start, chord.to);
        const auto  b = barycentric(placed.surface, chord.facet, end, chord.from);

        CutCells<2>::Fragment fragment;
        fragment.component = first_component + edges[edge].region;
        fragment.facet     = chord.facet;
        fragment.area_vector =
          -area_vector(std::array<dealii::Point<2>, 2>{{start.position, end.position}});
        for (unsigned int k = 0; k < 2; ++k)
          fragment.mean[k] = (a[k] + b[k]) / 2;
        fragment.products[0] = (2 * a[0] * a[1] + a[0] * b[1] + a[1] * b[0] + 2 * b[0] * b[1]) / 6;
        cut.fragments.push_back(fragment);
        cut.corners.points.push_back(start.position);
        cut.corners.points.push_back(end.position);
        cut.corners.first.push_back(cut.corners.points.size());
      }
  }


  unsigned int
  ComponentFinder<2>::find(CutCells<2> &cut, CutWorkspace<2> &work, const PlacedSurface<2> &placed)
  {
    const int    number          = cut.cells.size() - 1;
    const auto   cell            = cut.cells.back().index;
    const int    first_component = cut.components.size();
    const double volume          = cut.block.cell_volume(cell);
    edges.clear();
    unsigned int flags = collect_rectangle(edges, work, cut, placed, 2, cell);
    flags |= work.planar.find_regions(edges, 0, edges.size(), cut.block.rounding(cell) * volume);

    const int n_chords =
      edges.size() -
      std::count_if(edges.begin(), edges.end(), [](const auto &e) { return e.on_rim; });
    add_fragments(cut, work, placed, first_component);
    for (const auto &region : work.planar.regions())
      {
        dealii::Point<2> centroid;
        for (unsigned int d = 0; d < 2; ++d)
          centroid[d] = cut.block.planes().position(d, cell[d]) + region.centroid(d);
        cut.components.push_back({number, region.area, centroid});
        if (region.area < -reported_inversion * volume)
          flags |= cut_negative_volume;
      }

    // The sides in the order of collect_rectangle(): lower, right, upper, left.
    int next = n_chords;
    for (unsigned int side = 0; side < 4; ++side)
      {
        const unsigned int axis = 1 - side % 2;
        const int          end  = side == 1 || side == 2 ? 1 : 0;
        const int          face = cut.face_slots.find(cut.block.key(moved(cell, axis, end), axis));
        for (int p = cut.faces[face].first_piece; p < work.face_records[face].end_piece; ++p)
          cut.pieces[p].components[1 - end] = first_component + edges[next++].region;
        flags |= work.face_records[face].flags;
      }
    return flags;
  }


  dealii::Point<3>
  ComponentFinder<3>::local(const SplitSurface<3>::Corner &corner,
                            const CutWorkspace<3>         &work) const
  {
    return dealii::Point<3>(work.split.vertices[corner.vertex].position - origin);
  }


  int
  ComponentFinder<3>::root(int element)
  {
    while (elements[element].parent != element)
      element = elements[element].parent = elements[elements[element].parent].parent;
    return element;
  }


  unsigned int
  ComponentFinder<3>::find(CutCells<3> &cut, CutWorkspace<3> &work, const PlacedSurface<3> &placed)
  {
    const auto cell = cut.cells.back().index;
    for (unsigned int d = 0; d < 3; ++d)
      origin[d] = cut.block.planes().position(d, cell[d]);
    unsigned int flags = 0;
    for (unsigned int f = 0; f < 6; ++f)
      {
        face_numbers[f] = cut.face_slots.find(cut.block.key(moved(cell, f / 2, f % 2), f / 2));
        flags |= work.face_records[face_numbers[f]].flags;
      }
    elements.clear();
    uses.clear();
    add_fragments(cut, work, placed);
    if (flags & cut_needs_sampling)
      return flags; // the pieces of a sampled face have no edges: the cell is sampled too
    add_pieces(cut, work);
    flags |= unite(work.split.n_edges);
    sum_up(cut, work);
    flags |= attach_islands(cut, work);

    const int    first  = cut.components.size();
    const double volume = cut.block.cell_volume(cell);
    number_components(cut);
    for (int c = first; c < static_cast<int>(cut.components.size()); ++c)
      if (cut.components[c].volume < -reported_inversion * volume)
        flags |= cut_negative_volume;
    return flags;
  }


  void
  ComponentFinder<3>::add_fragments(CutCells<3>            &cut,
                                    const CutWorkspace<3>  &work,
                                    const PlacedSurface<3> &placed)
  {
    const auto &lists = work.split.fragments_in;
    fragments.clear();
    for (int f = lists.first(cut.block.key(cut.cells.back().index)); f != KeyedLists::none;
         f     = lists.next(f))
      {
            fragments.push_back(f);
            add_fragment(cut, work, placed, work.split.fragments[f]);
      }
  }


  void
  ComponentFinder<3>::add_fragment(CutCells<3>                     &cut,
                                   const CutWorkspace<3>           &work,
                                   const PlacedSurface<3>          &placed,
                                   const SplitSurface<3>::Fragment &fragment)
  {
    for (int i = fragment.begin; i < fragment.end; ++i)
      {
        const auto &corner = work.split.corners[i];
        uses.emplace_back(corner.edge, elements.size());
        cut.corners.points.push_back(work.split.vertices[corner.vertex].position);
      }
    cut.corners.first.push_back(cut.corners.points.size());
    const auto integrals = integrate_fragment(fragment, work.split, placed, origin);
    cut.fragments.push_back(integrals.fragment);
    Element element;
    element.sums   = integrals.sums;
    element.parent = elements.size();
    elements.push_back(element);
  }


  void
  ComponentFinder<3>::add_pieces(const CutCells<3> &cut, const CutWorkspace<3> &work)
  {
    const auto &cell = cut.cells.back().index;
    for (unsigned int f = 0; f < 6; ++f)
      {
        const auto        &face   = cut.faces[face_numbers[f]];
        const auto        &record = work.face_records[face_numbers[f]];
        const unsigned int axis   = f / 2;
        const double       height = f % 2 == 0 ? 0. : cut.block.planes().width(axis, cell[axis]);
        first_element[f]          = elements.size();
        for (int p = face.first_piece; p < record.end_piece; ++p)
          {
            Element element;
            element.parent = elements.size();
            // The normal points along the axis at the upper end; at the lower one x_axis = 0.
            element.sums.volume       = cut.pieces[p].area * height / 3;
            element.sums.moment[axis] = cut.pieces[p].area * height * height / 2;
            elements.push_back(element);
          }
        for (int i = record.first_planar; i < record.end_planar; ++i)
          {
            const auto      &edge = work.planar_edges[i];
            dealii::Point<3> place;
            place[axis]           = height;
            place[(axis + 1) % 3] = edge.start[0];
            place[(axis + 2) % 3] = edge.start[1];
            elements[first_element[f] + edge.region].sums.include(place);
            uses.emplace_back(edge.edge, first_element[f] + edge.region);
          }
      }
    first_element[6] = elements.size();
  }


  unsigned int
  ComponentFinder<3>::unite(const int n_edges)
  {
    users.resize(std::max<std::size_t>(users.size(), n_edges));
    for (const auto &[edge, element] : uses)
      {
        auto &user = users[edge];
        if (user.n_uses++ == 0)
          user.first = element;
        const int a = root(user.first), b = root(element);
        elements[std::max(a, b)].parent = std::min(a, b);
      }
    unsigned int flags = 0;
    for (const auto &use : uses)
      {
        auto &user = users[use.first];
        if (user.n_uses != 2 && user.n_uses != 0)
          flags |= cut_pairing;
        user.n_uses = 0;
      }
    return flags;
  }


  void
  ComponentFinder<3>::sum_up(const CutCells<3> &cut, const CutWorkspace<3> &work)
  {
    // A root is the lowest of its elements, so that it has its own sums already.
    for (int e = 0; e < static_cast<int>(elements.size()); ++e)
      if (const int r = root(e); r != e)
        elements[r].sums.add(elements[e].sums);
    for (unsigned int f = 0; f < 6; ++f)
      for (int e = first_element[f]; e < first_element[f + 1]; ++e)
        if (!work.debris_piece[cut.faces[face_numbers[f]].first_piece + e - first_element[f]])
          elements[root(e)].has_face = true;
  }


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


  unsigned int
  ComponentFinder<3>::attach_islands(const CutCells<3> &cut, const CutWorkspace<3> &work)
  {
    const auto  &cell     = cut.cells.back().index;
    const double rounding = cut.block.rounding(cell) * cut.block.cell_volume(cell);
    int          n_main = 0, main = -1;
    islands.clear();
    for (int e = 0; e < static_cast<int>(elements.size()); ++e)
      if (auto &element = elements[e]; element.parent == e)
        {
          if (element.has_face || element.sums.volume > rounding)
            {
              ++n_main;
              main = e;
            }
          else if (element.sums.volume < -rounding)
            islands.push_back(e);
          else
            element.debris = true;
        }
    if (islands.empty())
      return 0;
    unsigned int flags = 0;
    targets.assign(elements.size(), -1);
    for (const int island : islands)
      {
        targets[island] = n_main > 1 ? surroundings(cut, work, island) : main;
        if (targets[island] < 0)
          flags |= cut_nesting;
      }
    for (const int island : islands)
      {
        // Islands may hit islands; more steps than islands means that they go in circles.
        int         target = island;
        std::size_t steps  = 0;
        while (targets[target] >= 0 && steps++ <= islands.size())
          target = targets[target];
        if (target == island || targets[target] >= 0)
          {
            flags |= cut_nesting;
            continue;
          }
        elements[island].parent = target;
        elements[target].sums.add(elements[island].sums);
      }
    return flags;
  }


  void
  ComponentFinder<3>::number_components(CutCells<3> &cut)
  {
    const int cell = cut.cells.size() - 1;
    numbers.assign(elements.size(), -1);
    for (int e = 0; e < static_cast<int>(elements.size()); ++e)
      if (root(e) == e)
        {
          numbers[e]     = cut.components.size();
          auto component = elements[e].sums.centroid();
          for (unsigned int d = 0; d < 3; ++d)
            component[d] += origin[d];
          cut.components.push_back({cell, elements[e].sums.volume, component});
        }
    const int first_fragment = cut.cells.back().first_fragment;
    for (int e = 0; e < first_element[0]; ++e)
      cut.fragments[first_fragment + e].component = numbers[root(e)];
    for (unsigned int f = 0; f < 6; ++f)
      for (int e = first_element[f]; e < first_element[f + 1]; ++e)
        cut.pieces[cut.faces[face_numbers[f]].first_piece + e - first_element[f]]
          .components[1 - f % 2] = numbers[root(e)];
  }
} // namespace undine
