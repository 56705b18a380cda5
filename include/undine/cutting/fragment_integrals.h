// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_fragment_integrals_h
#define undine_cutting_fragment_integrals_h

#include <undine/cutting/cut_workspace.h>
#include <undine/cutting/part_sums.h>

namespace undine
{
  /// Integrals over a part of a triangle that lies in one cell.
  struct FragmentIntegrals
  {
    CutCells<3>::Fragment fragment; ///< without a component
    PartSums<3>           sums;     ///< its share, by the divergence theorem, of the fluid's part
  };

  /// Over `fragment` of a placed surface, in the cell whose lower corner is `origin` [m].
  FragmentIntegrals
  integrate_fragment(const SplitSurface<3>::Fragment &fragment,
                     const SplitSurface<3>           &split,
                     const PlacedSurface<3>          &placed,
                     const dealii::Point<3>          &origin);
} // namespace undine

#endif
