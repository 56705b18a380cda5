// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_cell_counts_h
#define undine_fluid_grid_cell_counts_h

#include <undine/fluid/grid/index_box.h>

#include <vector>

namespace undine
{
  /// How many cells of any box are marked, found in 2^dim steps from a table of the sums over all
  /// boxes that begin at the lowest cell (Crow, Summed-area tables for texture mapping, SIGGRAPH
  /// 1984).
  template <int dim>
  class CellCounts
  {
  public:
    /// No cells.
    CellCounts() = default;

    /// The marked cells are those of `box` for which is_marked(cell).
    template <class IsMarked>
    CellCounts(const IndexBox<dim> &box, const IsMarked &is_marked)
      : corners(box)
    {
      for (int &upper : corners.upper.values)
        ++upper;
      below.assign(corners.size(), 0);
      for_each(box, [&](GridIndex<dim> cell) {
        const int marked = is_marked(cell) ? 1 : 0;
        for (int &index : cell.values)
          ++index;
        below[corners.position(cell)] = marked;
      });
      for (unsigned int d = 0; d < dim; ++d)
        for_each(corners, [&](GridIndex<dim> corner) {
          auto &sum = below[corners.position(corner)];
          if (corner[d]-- > corners.lower[d])
            sum += below[corners.position(corner)];
        });
    }

    /// Number of marked cells in `cells`, a box that is not empty, within that of the constructor.
    int
    in(const IndexBox<dim> &cells) const
    {
      int sum = 0;
      for (unsigned int which = 0; which < (1u << dim); ++which)
        {
          GridIndex<dim> corner;
          int            sign = 1;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const bool upper = which >> d & 1;
              corner[d]        = upper ? cells.upper[d] : cells.lower[d];
              sign             = upper ? sign : -sign;
            }
          sum += sign * below[corners.position(corner)];
        }
      return sum;
    }

  private:
    IndexBox<dim>    corners; ///< of cells
    std::vector<int> below;   ///< of each, the marked cells that are below it in all directions
  };
} // namespace undine

#endif
