// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_dual_volumes_h
#define undine_operators_dual_volumes_h

#include <undine/cutting/cut_cells.h>

#include <vector>

namespace undine
{
  /// The volume V_f of fluid that moves with each open piece of a face: every component's volume is
  /// shared among its pieces of one direction in proportion to their areas. The sum over the pieces
  /// of one direction is the volume of the fluid, but for what limits change:
  ///
  /// - A component gives a piece at most `largest_share` times area times width of its cell. Behind
  ///   a narrow slot only little of a wide component moves: in the limit of no slot it has no share
  ///   at all. What is left over goes to no other direction, where it would double the inertia.
  /// - A piece has at least `smallest_volume` times area times the distance of the cells' centres.
  template <int dim>
  struct DualVolumes
  {
    /// A piece between uncut cells gets half its area times width from each.
    static constexpr double largest_share   = 2;
    static constexpr double smallest_volume = 0.05;

    std::vector<double> volumes; ///< of each piece [m^dim]

    /// Volumes of components that were not given to any piece, by component and direction [m^dim];
    /// all of it where there is no piece in that direction.
    std::vector<dealii::Tensor<1, dim>> unassigned;

    /// By how much the lower limit has raised the volumes of each direction, in sum [m^dim].
    dealii::Tensor<1, dim> added;
  };

  /// Dual volumes of all pieces of the block; correct for the faces of owned cells if the block has
  /// a halo. Not collective.
  template <int dim>
  DualVolumes<dim>
  dual_volumes(const CutCells<dim> &cut);
} // namespace undine

#endif
