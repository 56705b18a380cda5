// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_stencil_grid_h
#define undine_particles_stencil_grid_h

#include <undine/particles/cell_grid.h>

namespace undine::particles
{
  template <int dim>
  struct StencilGrid;

  template <>
  struct StencilGrid<0>
  {
    static constexpr int size = 1;
  };

  /// A grid of cells, of which each knows those around it: one level of the multigrid method. The
  /// finest has the cells of CellGrid, numbered in the same way.
  template <int dim>
  struct StencilGrid
  {
    static constexpr int size = 3 * StencilGrid<dim - 1>::size; ///< of a stencil

    int  cells[dim];
    int  strides[dim];
    bool periodic[dim];
    int  n;

    UNDINE_HOST_DEVICE
    int
    coordinate(const int cell, const int axis) const
    {
      return cell / strides[axis] % cells[axis];
    }

    /// Difference of coordinates, -1, 0 or 1, of cells that touch.
    UNDINE_HOST_DEVICE
    int
    difference(const int a, const int b, const int axis) const
    {
      const int d = a - b;
      return d > 1 ? d - cells[axis] : (d < -1 ? d + cells[axis] : d);
    }

    /// For the coordinate c of a cell: that of its neighbour, or its own where there is none.
    UNDINE_HOST_DEVICE
    int
    next_to(const int c, const int step, const int axis) const
    {
      const int other = c + step;
      if (other >= 0 && other < cells[axis])
        return other;
      return periodic[axis] ? (other < 0 ? other + cells[axis] : other - cells[axis]) : c;
    }
  };

  /// f(entry of the stencil, cell, its parent in the coarser grid), for all cells around one. Where
  /// there is no neighbour the cell itself stands in: the stencil is zero there.
  template <int dim, class Function>
  UNDINE_HOST_DEVICE
  void
  for_each_around(const StencilGrid<dim> &grid,
                  const StencilGrid<dim> &coarser,
                  const int               cell,
                  const Function         &f)
  {
    int indices[dim][3], parents[dim][3];
    for (int axis = 0; axis < dim; ++axis)
      {
        const int c = grid.coordinate(cell, axis);
        for (int step = 0; step < 3; ++step)
          {
            const int other     = grid.next_to(c, step - 1, axis);
            indices[axis][step] = other * grid.strides[axis];
            parents[axis][step] = other / 2 * coarser.strides[axis];
          }
      }
    UNDINE_UNROLL_ALL
    for (int entry = 0; entry < StencilGrid<dim>::size; ++entry)
      {
        int other = 0, parent = 0, rest = entry;
        for (int axis = 0; axis < dim; ++axis, rest /= 3)
          {
            other += indices[axis][rest % 3];
            parent += parents[axis][rest % 3];
          }
        f(entry, other, parent);
      }
  }

  /// Its cells are in twos along each axis.
  template <int dim>
  StencilGrid<dim>
  coarsened(const StencilGrid<dim> &grid)
  {
    StencilGrid<dim> result = grid;
    result.n                = 1;
    for (int axis = 0; axis < dim; ++axis)
      {
        result.cells[axis] = (grid.cells[axis] + 1) / 2;
        result.n *= result.cells[axis];
      }
    for (int axis = 0; axis < dim; ++axis)
      {
        result.strides[axis] = 1;
        for (int other = 0; other < dim; ++other)
          if (grid.strides[other] < grid.strides[axis] ||
              (grid.strides[other] == grid.strides[axis] && other < axis))
            result.strides[axis] *= result.cells[other];
      }
    return result;
  }
} // namespace undine::particles

#endif
