// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_grid_planes_h
#define undine_cutting_grid_planes_h

#include <undine/fluid/grid/index_box.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace undine
{
  /// The planes of a rectilinear grid, and which slab between them a coordinate lies in.
  ///
  /// The slab of x is the number of planes below x, minus one. A point on a plane counts as above
  /// it, on the lowest plane as below it: that is a symbolic perturbation, which moves every plane
  /// by an infinitesimal distance down its axis, the lowest one up. It spares all special cases of
  /// bodies that lie on planes. Those that stand on a side of the grid reach out of it.
  template <int dim>
  class GridPlanes
  {
  public:
    /// `positions` of the planes normal to each axis, ascending [m].
    explicit GridPlanes(const std::array<std::vector<double>, dim> &positions);

    /// Number of slabs between the planes normal to `axis`.
    int
    n_cells(const unsigned int axis) const
    {
      return planes[axis].size() - 1;
    }

    /// [m]
    double
    position(const unsigned int axis, const int plane) const
    {
      return planes[axis][plane];
    }

    /// [m]
    double
    width(const unsigned int axis, const int cell) const
    {
      return planes[axis][cell + 1] - planes[axis][cell];
    }

    /// The direction in which the perturbation moves a plane: 1 up, -1 down.
    static double
    shift(const int plane)
    {
      return plane == 0 ? 1. : -1.;
    }

    /// The slab in which `coordinate` [m] lies: -1 below all planes, n_cells above.
    int
    slab(const unsigned int axis, const double coordinate) const;

    /// The same for a coordinate that is known to lie in slabs lowest..highest.
    int
    slab_between(const unsigned int axis,
                 const double       coordinate,
                 const int          lowest,
                 const int          highest) const;

    /// Rounding level of lengths in a cell's slab, in units of its width: 8 ulp of the largest
    /// coordinate of the whole grid, at least of 16 widths. Areas and volumes below it are noise.
    double
    rounding(const unsigned int axis, const int cell) const
    {
      return rounding_levels[axis][cell];
    }

  private:
    std::array<std::vector<double>, dim> planes;
    std::array<std::vector<double>, dim> rounding_levels;
    std::array<double, dim>              mean_width;
  };


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
