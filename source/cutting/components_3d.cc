// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/component_finder.h>
#include <undine/cutting/cut_flags.h>

#include <algorithm>

namespace undine
{
  dealii::Point<3>
  ComponentFinder<3>::local(const SplitSurface<3>::Corner &corner,
                            const CutWorkspace<3>         &work) const
  {
    dealii::Point<3> result = work.split.vertices[corner.vertex].position;
    for (unsigned int d = 0; d < 3; ++d)
      result[d] -= origin[d];
    return result;
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
