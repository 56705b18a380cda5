// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/cut_cell_cache.h>
#include <undine/cutting/cut_workspace.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// The cell's facets, as the surface has been split: `is_so(facet)` of one that satisfies it,
    /// and if there are any at all. @{
    template <class Predicate>
    bool
    any_facet(const SplitSurface<2> &split, const std::int64_t key, const Predicate &is_so)
    {
      for (int c = split.chords_on.first(2 * key); c != KeyedLists::none;
           c     = split.chords_on.next(c))
        if (is_so(split.chords[c].facet))
          return true;
      return false;
    }

    template <class Predicate>
    bool
    any_facet(const SplitSurface<3> &split, const std::int64_t key, const Predicate &is_so)
    {
      for (int f = split.fragments_in.first(key); f != KeyedLists::none;
           f     = split.fragments_in.next(f))
        if (is_so(split.fragments[f].facet))
          return true;
      return false;
    }
    /// @}


    template <int dim>
    bool
    has_facets(const SplitSurface<dim> &split, const std::int64_t key)
    {
      return any_facet(split, key, [](const int) { return true; });
    }
  } // namespace


  template <int dim>
  typename CutCellCache<dim>::Windings
  CutCellCache<dim>::windings_around(const CutCells<dim> &cut, const GridIndex<dim> &cell)
  {
    Windings result;
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      {
        auto node = cell;
        for (unsigned int d = 0; d < dim; ++d)
          node[d] += (corner >> d) & 1;
        result[corner] = cut.windings[cut.block.key(node)];
      }
    return result;
  }


  template <int dim>
  bool
  CutCellCache<dim>::knows(const CutCells<dim> &cut, const PlacedSurface<dim> &placed)
  {
    // The remembered block keeps its planes alive: no others can have their address.
    const bool known = block && &block->planes() == &cut.block.planes() &&
                       block->cells() == cut.block.cells() && facets == placed.surface.facets() &&
                       positions.size() == placed.positions.size();
    if (!known)
      {
        block  = cut.block;
        facets = placed.surface.facets();
      }
    return known;
  }


  template <int dim>
  void
  CutCellCache<dim>::compare(const CutCells<dim>      &cut,
                             const SplitSurface<dim>  &split,
                             const PlacedSurface<dim> &placed)
  {
    n_cached_cells = 0;
    if (!knows(cut, placed))
      {
        slots.clear();
        cells.clear();
        has_moved.assign(facets.size(), true);
        return;
      }
    for (std::size_t facet = 0; facet < facets.size(); ++facet)
      has_moved[facet] =
        std::any_of(facets[facet].begin(), facets[facet].end(), [&](const unsigned int node) {
          return positions[node] != placed.positions[node];
        });
    const auto moves = [&](const int facet) { return has_moved[facet]; };
    for (int slot = 0; slot < slots.size(); ++slot)
      {
        const auto key  = slots.key(slot);
        auto      &cell = cells[slot];
        bool       left = false; // has a facet moved that was in it?
        for (auto f = cell.fragments[0]; f < cell.fragments[1]; ++f)
          left = left || moves(fragments[f].fragment.facet);
        cell.is_cached = split.failures == 0 && !left && has_facets(split, key) &&
                         !any_facet(split, key, moves) &&
                         cell.windings == windings_around(cut, cut.block.node(key));
        n_cached_cells += cell.is_cached;
      }
  }


  template <int dim>
  void
  CutCellCache<dim>::find_faces(CutCells<dim>            &cut,
                                CutWorkspace<dim>        &work,
                                const PlacedSurface<dim> &placed,
                                const std::int64_t        key) const
  {
    const auto  index = cut.block.node(key);
    const auto &cell  = cells[slots.find(key)];
    for (unsigned int side = 0; side < n_sides; ++side)
      {
        const unsigned int axis        = side / 2;
        const int          end         = side % 2;
        const auto         face        = moved(index, axis, end);
        const auto         next        = moved(index, axis, end == 0 ? -1 : 1);
        const bool         is_alone    = !cut.block.cells().contains(next);
        const auto         key_of_next = is_alone ? 0 : cut.block.key(next);
        if (is_alone || hold(key_of_next) || !has_facets(work.split, key_of_next))
          add_face(cut, work, cell, side, face);
        else
          find_face(cut, work, placed, axis, face);
      }
  }


  template <int dim>
  void
  CutCellCache<dim>::add_face(CutCells<dim>        &cut,
                              CutWorkspace<dim>    &work,
                              const Cell           &cell,
                              const unsigned int    side,
                              const GridIndex<dim> &face) const
  {
    const int number = cut.face_slots.add(cut.block.key(face, side / 2));
    if (number < static_cast<int>(cut.faces.size()))
      return;
    cut.faces.push_back({side / 2, face, static_cast<int>(cut.pieces.size())});
    for (auto p = cell.pieces[side]; p < cell.pieces[side + 1]; ++p)
      {
        cut.pieces.push_back(pieces[p].piece);
        cut.pieces.back().face       = number;
        cut.pieces.back().components = {{cut.outside, cut.outside}};
        work.debris_piece.push_back(pieces[p].is_debris);
      }
    work.face_records.emplace_back();
    work.face_records.back().end_piece = cut.pieces.size();
  }


  template <int dim>
  double
  CutCellCache<dim>::add_cell(CutCells<dim> &cut, const std::int64_t key) const
  {
    const auto &cell   = cells[slots.find(key)];
    const int   number = cut.cells.size(), first = cut.components.size();
    cut.cell_slots.add(key);
    cut.cells.push_back({cut.block.node(key), first, static_cast<int>(cut.fragments.size()), 0});
    for (auto c = cell.components[0]; c < cell.components[1]; ++c)
      cut.components.push_back({number, components[c].volume, components[c].centroid});
    for (auto f = cell.fragments[0]; f < cell.fragments[1]; ++f)
      {
        cut.fragments.push_back(fragments[f].fragment);
        cut.fragments.back().component += first;
        cut.corners.points.insert(cut.corners.points.end(),
                                  corners.begin() + fragments[f].corners[0],
                                  corners.begin() + fragments[f].corners[1]);
        cut.corners.first.push_back(cut.corners.points.size());
      }
    for (unsigned int side = 0; side < n_sides; ++side)
      {
        const auto face = moved(cut.cells.back().index, side / 2, side % 2);
        auto       p    = cut.faces[cut.cut_face(side / 2, face)].first_piece;
        for (auto k = cell.pieces[side]; k < cell.pieces[side + 1]; ++k, ++p)
          cut.pieces[p].components[1 - side % 2] = first + pieces[k].component;
      }
    return cell.closure_defect;
  }


  template <int dim>
  void
  CutCellCache<dim>::remember(const CutCells<dim>      &cut,
                              const CutWorkspace<dim>  &work,
                              const PlacedSurface<dim> &placed)
  {
    positions = placed.positions;
    slots.clear();
    cells.clear();
    components.clear();
    fragments.clear();
    corners.clear();
    pieces.clear();
    // Cells with anything unusual are computed anew each time.
    const bool is_usual = work.grid_edges.n_reordered() == 0 && work.split.failures == 0;
    for (int c = 0; is_usual && c < static_cast<int>(cut.cells.size()); ++c)
      {
        bool at_rest = cut.cells[c].flags == 0;
        for (int f = cut.cells[c].first_fragment; at_rest && f < cut.end_fragment(c); ++f)
          at_rest = !has_moved[cut.fragments[f].facet];
        if (at_rest)
          remember_cell(cut, work, c);
      }
  }


  template <int dim>
  void
  CutCellCache<dim>::remember_cell(const CutCells<dim>     &cut,
                                   const CutWorkspace<dim> &work,
                                   const int                number)
  {
    const auto &index = cut.cells[number].index;
    const int   first = cut.cells[number].first_component;
    Cell        cell{};
    cell.windings       = windings_around(cut, index);
    cell.closure_defect = work.closure_defects[number];
    cell.components[0]  = components.size();
    components.insert(components.end(),
                      cut.components.begin() + first,
                      cut.components.begin() + cut.end_component(number));
    cell.components[1] = components.size();
    cell.fragments[0]  = fragments.size();
    for (int f = cut.cells[number].first_fragment; f < cut.end_fragment(number); ++f)
      {
        const auto begin = cut.corners.points.begin() + cut.corners.first[f];
        const auto end   = cut.corners.points.begin() + cut.corners.first[f + 1];
        fragments.push_back({cut.fragments[f], {{corners.size(), corners.size() + (end - begin)}}});
        fragments.back().fragment.component -= first;
        corners.insert(corners.end(), begin, end);
      }
    cell.fragments[1] = fragments.size();
    for (unsigned int side = 0; side < n_sides; ++side)
      {
        cell.pieces[side] = pieces.size();
        const int face    = cut.cut_face(side / 2, moved(index, side / 2, side % 2));
        for (int p = cut.faces[face].first_piece; p < work.face_records[face].end_piece; ++p)
          pieces.push_back({cut.pieces[p],
                            work.debris_piece[p] != 0,
                            cut.pieces[p].components[1 - side % 2] - first});
      }
    cell.pieces[n_sides] = pieces.size();
    cells.push_back(cell);
    slots.add(cut.block.key(index));
  }


  template <int dim>
  std::size_t
  CutCellCache<dim>::memory_consumption() const
  {
    const auto bytes = [](const auto &...lists) {
      return ((lists.capacity() * sizeof(lists.front())) + ...);
    };
    return bytes(facets, positions, has_moved, cells, components, fragments, corners, pieces);
  }


  template class CutCellCache<2>;
  template class CutCellCache<3>;
} // namespace undine
