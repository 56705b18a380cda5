// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_node_windings_h
#define undine_cutting_node_windings_h

#include <undine/cutting/grid_block.h>
#include <undine/fluid/grid/blocks.h>

#include <cstdint>
#include <vector>

namespace undine
{
  /// How many bodies each node of the grid lies in: 0 fluid, 1 solid; anything else where bodies
  /// overlap or are inside out. Prefix sums of crossings along the grid's lines of axis 0.
  template <int dim>
  class NodeWindings
  {
  public:
    /// All nodes in the fluid.
    void
    reset(const GridBlock<dim> &block);

    /// The surface crosses the line of axis 0 below `node`: `sign` = +1 where the solid begins.
    void
    add_crossing(const GridBlock<dim> &block, const GridIndex<dim> &node, const int sign)
    {
      windings[block.key(node)] += sign;
    }

    /// Sum up along the lines.
    void
    accumulate(const GridBlock<dim> &block);

    /// Add what lies between the domain's lower side and this block, by a scan over the ranks
    /// whose blocks lie in one row along axis 0. Collective.
    void
    add_lower_blocks(const GridBlock<dim> &block, const Blocks<dim> &blocks);

    /// The winding number of a node, by GridBlock::key(node).
    int
    operator[](const std::int64_t key) const
    {
      return windings[key];
    }

  private:
    std::vector<std::int16_t> windings; ///< by GridBlock::key(node)
  };
} // namespace undine

#endif
