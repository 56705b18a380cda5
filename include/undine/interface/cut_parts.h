// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_interface_cut_parts_h
#define undine_interface_cut_parts_h

#include <undine/fluid/mac_grid.h>
#include <undine/fluid/open_parts.h>
#include <undine/interface/cut_cells.h>

#include <memory>
#include <vector>

namespace undine
{
  /// What cut cells leave of the grid, in the fluid's terms, and how its components are numbered in
  /// either.
  template <int dim>
  struct CutParts
  {
    std::shared_ptr<const OpenParts<dim>> open;

    /// Number in CutCells::components of each component of open->cells; -1 for images of cells that
    /// this rank has not cut.
    std::vector<int> cut_components;

    /// The inverse: number in open->cells of each of CutCells::components; -1 if the fluid knows
    /// less of the grid than the block.
    std::vector<int> open_components;

    /// Values of the components of open->cells, ordered as CutCells::components; what is unknown
    /// there is zero.
    std::vector<double>
    of_cut_cells(const std::vector<double> &values) const;

    /// The other way round.
    std::vector<double>
    of_open_parts(const std::vector<double> &values) const;
  };

  /// `cut` must come from a block of this rank's cells with a halo, see block_of_rank(). Bodies may
  /// come near to periodic sides but not reach them: the pieces there are whole faces. Where
  /// samples say otherwise, the face is closed. Collective.
  template <int dim>
  CutParts<dim>
  make_open_parts(const MacGrid<dim> &grid, const CutCells<dim> &cut);
} // namespace undine

#endif
