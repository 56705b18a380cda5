// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_cut_block_h
#define undine_cutting_cut_block_h

#include <undine/cutting/cut_workspace.h>
#include <undine/fluid/grid/mac_grid.h>

namespace undine
{
  /// Components and pieces smaller than this, in units of a cell or face, are excluded from the
  /// flow; so are those below twice the rounding level (GridBlock::rounding), which exceeds it
  /// where a coordinate of the grid is larger than 28 widths of the cell.
  constexpr double negligible_size = 1e-13;

  /// The cells of this rank and a halo of one layer, which both sides of all owned faces need. It
  /// does not reach beyond periodic sides, nor must bodies.
  template <int dim>
  GridBlock<dim>
  block_of_rank(const MacGrid<dim> &grid);

  /// Cut the cells of cut.block, which spans the domain along axis 0, by a surface. Overwrites
  /// `cut`; `work` keeps memory and cached cells from one call to the next. Not collective. Throws
  /// SolveError if a position is not finite; overlaps and the like are flagged instead, see
  /// CutReport.
  template <int dim>
  void
  cut_block(CutCells<dim> &cut, CutWorkspace<dim> &work, const PlacedSurface<dim> &placed);

  /// The same for the block of this rank, cut.block.owned() being its cells in `blocks`. The
  /// surface must have all facets that facets_near() returns, and may have more. Collective.
  template <int dim>
  void
  cut_block(CutCells<dim>            &cut,
            CutWorkspace<dim>        &work,
            const PlacedSurface<dim> &placed,
            const Blocks<dim>        &blocks);

  /// The last stage of cut_block(): set the uncut neighbours of pieces, drop components of
  /// negligible volume and aperture, and close negligible pieces.
  template <int dim>
  void
  drop_debris(CutCells<dim> &cut);

  /// After drop_debris(): make pieces and fragments close around the components of sampled cells,
  /// so that bodies that move alike have no surface flux into a component that cannot leave it. The
  /// vector that is missing is distributed over the fragments in proportion to their areas. What
  /// fragments contribute beyond that, which counts where bodies move towards each other, is
  /// limited to the area of the pieces: openings that samples do not resolve let out no more than
  /// the bodies' relative speed times their area.
  template <int dim>
  void
  close_sampled_cells(CutCells<dim> &cut);
} // namespace undine

#endif
