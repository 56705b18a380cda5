// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_fluid_topology_h
#define undine_fluid_grid_fluid_topology_h

#include <undine/fluid/grid/sub_lattice.h>

#include <array>
#include <vector>

namespace undine
{
  /// The topology of the fluid: what surfaces leave of the grid. Divided cells consist of
  /// sub-cells, the components of their fluid, with one pressure each; divided faces of sub-faces,
  /// their open pieces, with one velocity each. All faces of divided cells are divided, open ones
  /// into a single piece. Every rank that knows a divided cell or face knows the same of it.
  template <int dim>
  struct FluidTopology
  {
    /// Ends of a piece that are not components. @{
    static constexpr int outside = -1; ///< beyond the domain, or beyond the cells this rank knows
    static constexpr int whole   = -2; ///< a cell that is not divided
    /// @}

    /// A sub-face: what moves with its velocity, and which pressures it joins.
    struct Piece
    {
      double             volume;     ///< V_f: of the fluid that moves with it [m^dim]
      std::array<int, 2> components; ///< below and above: numbers in `cells`, `whole` or `outside`
    };

    /// How the points of a lattice of this grid are divided.
    const SubLattice<dim> &
    of(const Lattice<dim> &lattice) const
    {
      return lattice.normal_axis() == Lattice<dim>::no_axis ? cells : faces[lattice.normal_axis()];
    }

    SubLattice<dim>                     cells;
    std::array<SubLattice<dim>, dim>    faces;
    std::array<std::vector<Piece>, dim> pieces; ///< [axis][number in `faces[axis].all()`]
  };
} // namespace undine

#endif
