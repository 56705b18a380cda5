// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/cut_block.h>

#include <cmath>

namespace undine
{
  namespace
  {
    template <int dim>
    double
    negligible(const CutCells<dim> &cut, const GridIndex<dim> &cell)
    {
      return std::max(negligible_size, 2 * cut.block.rounding(cell));
    }


    template <int dim>
    bool
    is_negligible(const CutCells<dim> &cut, const typename CutCells<dim>::Piece &piece)
    {
      const auto &face = cut.faces[piece.face];
      auto        cell = face.index; // the last face belongs to the last cell
      cell[face.axis]  = std::min(cell[face.axis], cut.block.planes().n_cells(face.axis) - 1);
      return std::abs(piece.area) < negligible(cut, cell) * cut.block.face_area(face.axis, cell);
    }


    /// True on the sides of the grid.
    template <int dim>
    bool
    is_at_side(const CutCells<dim> &cut, const typename CutCells<dim>::Piece &piece)
    {
      const auto &face = cut.faces[piece.face];
      return face.index[face.axis] == 0 ||
             face.index[face.axis] == cut.block.planes().n_cells(face.axis);
    }


    /// Tell pieces whose neighbour is not cut what it is instead.
    template <int dim>
    void
    find_uncut_neighbours(CutCells<dim> &cut, std::vector<char> &closed)
    {
      for (std::size_t p = 0; p < cut.pieces.size(); ++p)
        {
          const auto &face = cut.faces[cut.pieces[p].face];
          for (const int end : {0, 1})
            {
              const auto cell = moved(face.index, face.axis, end - 1);
              auto      &side = cut.pieces[p].components[end];
              if (side != cut.outside || !cut.block.cells().contains(cell))
                continue;
              side = cut.uncut;
              // Only beside cells that have been sampled.
              if (cut.in_solid(cell))
                closed[p] = true;
            }
        }
    }


    /// Whether components are excluded from the flow.
    template <int dim>
    std::vector<char>
    find_negligible_components(const CutCells<dim> &cut)
    {
      std::vector<char> result(cut.components.size());
      for (std::size_t c = 0; c < result.size(); ++c)
        {
          const auto &component = cut.components[c];
          result[c] =
            std::abs(component.volume) < negligible(cut, cut.cells[component.cell].index) *
                                           cut.block.cell_volume(cut.cells[component.cell].index);
        }
      for (const auto &piece : cut.pieces)
        {
          // Between a body and a side of the grid nothing flows without volume.
          if (is_negligible(cut, piece) || is_at_side(cut, piece))
            continue;
          for (const int c : piece.components)
            if (c >= 0)
              result[c] = false;
        }
      return result;
    }


    /// Remove the components marked, and renumber.
    template <int dim>
    void
    remove_components(CutCells<dim> &cut, const std::vector<char> &remove)
    {
      std::vector<int> numbers(remove.size() + 1);
      int              n = 0;
      for (std::size_t c = 0; c < remove.size(); ++c)
        {
          numbers[c] = n;
          if (!remove[c])
            cut.components[n++] = cut.components[c];
        }
      numbers.back() = n;
      cut.counts.debris += cut.components.size() - n;
      cut.components.resize(n);
      for (auto &cell : cut.cells)
        cell.first_component = numbers[cell.first_component];
      for (auto &fragment : cut.fragments)
        if (fragment.component >= 0)
          fragment.component =
            remove[fragment.component] ? cut.no_component : numbers[fragment.component];
      for (auto &piece : cut.pieces)
        for (int &c : piece.components)
          if (c >= 0)
            c = numbers[c];
    }


    template <int dim>
    void
    remove_pieces(CutCells<dim> &cut, const std::vector<char> &remove)
    {
      int n = 0;
      for (std::size_t face = 0, p = 0; face < cut.faces.size(); ++face)
        {
          cut.faces[face].first_piece = n;
          for (; p < remove.size() && cut.pieces[p].face == static_cast<int>(face); ++p)
            if (!remove[p])
              cut.pieces[n++] = cut.pieces[p];
        }
      cut.counts.closed_pieces += cut.pieces.size() - n;
      cut.pieces.resize(n);
    }
  } // namespace


  template <int dim>
  void
  drop_debris(CutCells<dim> &cut)
  {
    std::vector<char> closed(cut.pieces.size(), false);
    find_uncut_neighbours(cut, closed);
    const auto dropped = find_negligible_components(cut);
    for (std::size_t p = 0; p < cut.pieces.size(); ++p)
      {
        closed[p] = closed[p] || is_negligible(cut, cut.pieces[p]);
        for (const int c : cut.pieces[p].components)
          closed[p] = closed[p] || (c >= 0 && dropped[c]);
      }
    remove_components(cut, dropped);
    remove_pieces(cut, closed);
  }


  template void
  drop_debris(CutCells<2> &);
  template void
  drop_debris(CutCells<3> &);
} // namespace undine
