// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_fluid_topology_h
#define undine_fluid_grid_fluid_topology_h

#include <undine/fluid/grid/sub_lattice.h>

#include <array>
#include <vector>

namespace undine
{
  /// What bodies leave of the grid to the fluid: one pressure for each component of a cell, one
  /// velocity for each piece of a face. The same on every rank that knows a part. All faces of
  /// divided cells are divided, open ones into a single piece.
  template <int dim>
  struct FluidTopology
  {
    /// What a piece joins if not two components. @{
    static constexpr int outside = -1; ///< beyond the domain, or beyond the cells this rank knows
    static constexpr int whole   = -2; ///< a cell that is not divided
    /// @}

    struct Piece
    {
      double             volume;     ///< V_f: of the fluid that moves with it [m^dim]
      std::array<int, 2> components; ///< below and above: numbers in `cells`, `whole` or `outside`
    };

    /// What is left of a lattice of this grid.
    const SubLattice<dim> &
    of(const Lattice<dim> &lattice) const
    {
      return lattice.normal_axis() == Lattice<dim>::no_axis ? cells : faces[lattice.normal_axis()];
    }

    SubLattice<dim>                     cells;
    std::array<SubLattice<dim>, dim>    faces;
    std::array<std::vector<Piece>, dim> pieces; ///< [axis][part of `faces[axis]`]
  };
} // namespace undine

#endif
