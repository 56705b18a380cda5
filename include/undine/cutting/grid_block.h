// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_grid_block_h
#define undine_cutting_grid_block_h

#include <undine/cutting/grid_planes.h>
#include <undine/fluid/grid/index_box.h>

#include <algorithm>
#include <cstdint>
#include <memory>

namespace undine
{
  /// The part of a grid that one rank computes.
  template <int dim>
  class GridBlock
  {
  public:
    /// `owned` cells and `halo` more layers on either side, as far as there are cells.
    GridBlock(std::shared_ptr<const GridPlanes<dim>> planes,
              const IndexBox<dim>                   &owned,
              const int                              halo);

    const GridPlanes<dim> &
    planes() const
    {
      return *grid_planes;
    }

    /// The cells that this rank owns.
    const IndexBox<dim> &
    owned() const
    {
      return owned_cells;
    }

    /// The owned cells and the halo.
    const IndexBox<dim> &
    cells() const
    {
      return all_cells;
    }

    /// The crossings of planes, those on the rim of the block included.
    const IndexBox<dim> &
    nodes() const
    {
      return all_nodes;
    }

    /// True if no other block lies below this one along `axis`.
    bool
    at_lower_end(const unsigned int axis) const
    {
      return all_cells.lower[axis] == 0;
    }

    /// A slab as far as this block can tell: one below its cells, or one above.
    int
    clamped(const unsigned int axis, const int slab) const
    {
      return std::clamp(slab, all_cells.lower[axis] - 1, all_cells.upper[axis]);
    }

    /// One whole number for a node, and for the cell, faces and edges that begin there. @{
    std::int64_t
    key(const GridIndex<dim> &node) const
    {
      return all_nodes.position(node);
    }

    std::int64_t
    key(const GridIndex<dim> &node, const unsigned int axis) const
    {
      return key(node) * dim + axis;
    }

    GridIndex<dim>
    node(std::int64_t key) const
    {
      GridIndex<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const int length = all_nodes.upper[d] - all_nodes.lower[d];
          result[d]        = all_nodes.lower[d] + static_cast<int>(key % length);
          key /= length;
        }
      return result;
    }
    /// @}

    /// `coordinate` relative to the lower plane of slab `cell` [m].
    double
    local(const unsigned int axis, const int cell, const double coordinate) const
    {
      return coordinate - grid_planes->position(axis, cell);
    }

    /// [m^dim]
    double
    cell_volume(const GridIndex<dim> &cell) const;

    /// Area of a face normal to `axis` [m^(dim-1)].
    double
    face_area(const unsigned int axis, const GridIndex<dim> &face) const;

    /// Rounding level of a cell's volume, in units of it.
    double
    rounding(const GridIndex<dim> &cell) const;

  private:
    std::shared_ptr<const GridPlanes<dim>> grid_planes;
    IndexBox<dim>                          owned_cells, all_cells, all_nodes;
  };
} // namespace undine

#endif
