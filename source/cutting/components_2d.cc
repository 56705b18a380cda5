// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/chord_splitter.h>
#include <undine/cutting/component_finder.h>
#include <undine/cutting/cut_flags.h>
#include <undine/surface/simplex.h>

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
} // namespace undine
