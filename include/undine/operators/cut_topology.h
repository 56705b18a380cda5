// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_cut_topology_h
#define undine_operators_cut_topology_h

#include <undine/cutting/cut_cells.h>
#include <undine/fluid/grid/fluid_topology.h>
#include <undine/fluid/grid/mac_grid.h>

#include <array>
#include <memory>
#include <vector>

namespace undine
{
  /// Space outside all bodies that holds no fluid: for each component and cell the number of its
  /// void region, or one of the constants.
  struct VoidMask
  {
    static constexpr int fluid     = -1;
    static constexpr int not_whole = -2; ///< a cell that is cut or in a body
    static constexpr int solid     = -3; ///< a component that counts as part of the bodies

    std::vector<int> components; ///< [CutCells::components]; empty: all fluid
    std::vector<int> cells;      ///< by GridBlock::cells().position(); empty: all fluid

    /// True if it is void or solid.
    bool
    holds_component(const int component) const
    {
      return !components.empty() && components[component] != fluid;
    }

    /// True if the whole cell at this position of GridBlock::cells() is in a void region.
    bool
    holds_cell(const std::size_t position) const
    {
      return !cells.empty() && cells[position] >= 0;
    }
  };

  /// The topology that cut cells leave to the fluid, and the correspondence between the numbers of
  /// components and pieces in both.
  template <int dim>
  struct CutTopology
  {
    std::shared_ptr<const FluidTopology<dim>> open;

    /// Number in CutCells::components of each component of open->cells; -1 for images of cells that
    /// this rank has not cut.
    std::vector<int> cut_components;

    /// The inverse: number in open->cells of each of CutCells::components; -1 if it is void, or if
    /// the fluid knows less of the grid than the block.
    std::vector<int> open_components;

    /// [axis][number in open->faces]: number in CutCells::pieces; -1 for those that other ranks own
    /// and on periodic sides.
    std::array<std::vector<int>, dim> cut_pieces;

    /// `values` [open->cells] of components, ordered as [CutCells::components]; zero where
    /// open_components is -1. Not collective.
    std::vector<double>
    of_cut_cells(const std::vector<double> &values) const;

    /// The inverse: `values` [CutCells::components], ordered as [open->cells]; zero where
    /// cut_components is -1. Not collective.
    std::vector<double>
    of_fluid_topology(const std::vector<double> &values) const;
  };

  /// The topology of the fluid of the whole grid, from the cells that each rank has cut. `cut` must
  /// come from a block of this rank's cells with a halo, see block_of_rank(). Bodies may come near
  /// to periodic sides but not reach them: the pieces there are whole faces; where sampled cells
  /// say otherwise, the face is closed. Cells and components that are void count as closed.
  /// Collective.
  template <int dim>
  CutTopology<dim>
  make_cut_topology(const MacGrid<dim>  &grid,
                    const CutCells<dim> &cut,
                    const VoidMask      &voids = VoidMask());
} // namespace undine

#endif
