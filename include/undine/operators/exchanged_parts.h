// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_exchanged_parts_h
#define undine_operators_exchanged_parts_h

#include <undine/fluid/grid/field.h>
#include <undine/fluid/grid/sub_lattice.h>

#include <algorithm>
#include <functional>
#include <memory>

namespace undine
{
  /// How many sub-cells or sub-faces a point has, as a number in a field: 0, 1, 2, ... or one of
  /// these. @{
  constexpr int count_whole  = -1;
  constexpr int count_closed = -2;
  /// @}

  /// The sub-cells or sub-faces of a lattice's points, from those of the points that each rank
  /// owns: their `counts`, and part(index, number in its point). At images of points they are
  /// shifted along. Collective.
  template <int dim>
  SubLattice<dim>
  make_exchanged_parts(
    const std::shared_ptr<const Lattice<dim>>                                        &lattice,
    Field<dim>                                                                        counts,
    const std::function<typename SubLattice<dim>::Part(const GridIndex<dim> &, int)> &part);
} // namespace undine

#endif
