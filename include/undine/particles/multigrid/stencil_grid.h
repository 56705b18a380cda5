// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_multigrid_stencil_grid_h
#define undine_particles_multigrid_stencil_grid_h

#include <undine/particles/model/cell_grid.h>

namespace undine::particles
{
  template <int dim>
  struct StencilGrid;

  template <int dim>
  struct StencilCell;

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

    /// As if it had no children.
    UNDINE_HOST_DEVICE
    StencilCell<dim>
    cell(const int index) const
    {
      StencilCell<dim> result = {};
      for (int axis = 0; axis < dim; ++axis)
        result.coordinates[axis] = coordinate(index, axis);
      return result;
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
      const int  other  = c + step;
      const int  beyond = periodic[axis] ? (step < 0 ? cells[axis] - 1 : 0) : c;
      const bool exists = other >= 0 && other < cells[axis];
      return exists ? other : beyond;
    }
  };

  /// A cell that has unknowns, with which of its children in the finer grid do, as bits; in the
  /// finest grid, which of its next ones along each axis do.
  template <int dim>
  struct alignas(16) StencilCell
  {
    int          coordinates[dim];
    unsigned int children;

    UNDINE_HOST_DEVICE
    int
    index(const StencilGrid<dim> &grid) const
    {
      int result = 0;
      for (int axis = 0; axis < dim; ++axis)
        result += coordinates[axis] * grid.strides[axis];
      return result;
    }

    /// That which number `child` is, if it exists in the finer grid.
    UNDINE_HOST_DEVICE
    StencilCell
    child(const int child) const
    {
      StencilCell result = {};
      for (int axis = 0; axis < dim; ++axis)
        result.coordinates[axis] = 2 * coordinates[axis] + (child >> axis & 1);
      return result;
    }

    UNDINE_HOST_DEVICE
    static unsigned int
    bit_of_next(const int axis, const int step)
    {
      return 1u << (2 * axis + (step > 0 ? 1 : 0));
    }

    UNDINE_HOST_DEVICE
    bool
    has_next(const int axis, const int step) const
    {
      return (children & bit_of_next(axis, step)) != 0;
    }

    /// The index of its parent.
    UNDINE_HOST_DEVICE
    int
    parent(const StencilGrid<dim> &coarser) const
    {
      int result = 0;
      for (int axis = 0; axis < dim; ++axis)
        result += coordinates[axis] / 2 * coarser.strides[axis];
      return result;
    }
  };

  /// f(entry of the stencil, cell, its parent in the coarser grid), for all cells around one that
  /// are this lane's. Where there is no neighbour the cell itself stands in: the stencil is zero
  /// there.
  template <int dim, class Lanes, class Function>
  UNDINE_HOST_DEVICE
  void
  for_each_around(const StencilGrid<dim> &grid,
                  const StencilGrid<dim> &coarser,
                  const StencilCell<dim> &cell,
                  const Lanes            &lanes,
                  const Function         &f)
  {
    constexpr int size = StencilGrid<dim>::size;
    int           indices[dim][3], parents[dim][3];
    UNDINE_UNROLL_ALL
    for (int axis = 0; axis < dim; ++axis)
      UNDINE_UNROLL_ALL
    for (int step = 0; step < 3; ++step)
      {
        const int c         = grid.next_to(cell.coordinates[axis], step - 1, axis);
        indices[axis][step] = c * grid.strides[axis];
        parents[axis][step] = c / 2 * coarser.strides[axis];
      }
    UNDINE_UNROLL_ALL
    for (int first = 0; first < size; first += Lanes::count())
      {
        const int entry = first + lanes.rank();
        int       other = 0, parent = 0, rest = entry;
        UNDINE_UNROLL_ALL
        for (int axis = 0; axis < dim; ++axis, rest /= 3)
          {
            const int step = rest % 3;
            other += step == 0 ? indices[axis][0] : step == 1 ? indices[axis][1] : indices[axis][2];
            parent += step == 0   ? parents[axis][0]
                      : step == 1 ? parents[axis][1]
                                  : parents[axis][2];
          }
        if (entry < size)
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
