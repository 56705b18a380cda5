// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_multigrid_coarsening_h
#define undine_base_multigrid_coarsening_h

#include <undine/base/multigrid/cell_equations.h>

namespace undine
{
  /// How unknowns are gathered for a coarser level, and the equations there.
  struct Coarsening
  {
    static constexpr int none = -1;

    std::vector<int> aggregates; ///< number in `equations` of every owned unknown, or none
    CellEquations    equations;
  };

  /// A block of `width` cells of the grid in each direction becomes one unknown for each of its
  /// parts that are joined by strong couplings: what a thin body divides remains divided. Blocks
  /// begin at `origin`, the lowest cell of this rank. Unknowns without couplings are in none.
  ///
  /// Unknowns of a block have one value. That alone would couple coarse unknowns as strongly as all
  /// faces between them do side by side, although they are further apart: a coupling is the sum of
  /// the fine ones, times their distance over the coarse one [Braess, Computing 55 (1995) 379; Mohr
  /// and Wienands, Comput. Vis. Sci. 7 (2004) 129]. What flows outward through the end of the
  /// domain is treated alike. The rest is summed. Collective.
  Coarsening
  coarsen(const CellEquations      &fine,
          const std::array<int, 3> &width,
          const std::array<int, 3> &origin,
          const CellEquations::Box &domain);
} // namespace undine

#endif
