// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_model_cell_grid_h
#define undine_particles_model_cell_grid_h

#include <undine/particles/math/vector.h>

#include <cmath>

namespace undine::particles
{
  /// The box that holds all particles, in cells no smaller than the reach of the weight: neighbours
  /// of a particle are in its cell or in those around it. Cells along the shortest axis follow each
  /// other in memory and the longest axis is the slowest, which keeps neighbours close to each
  /// other in sorted order.
  template <int dim, class Real>
  struct CellGrid
  {
    Vector<dim, Real> lower;        ///< corner [m]
    Vector<dim, Real> size;         ///< extents [m]
    Vector<dim, Real> inverse_cell; ///< [1/m]
    int               cells[dim];   ///< along each axis
    bool              periodic[dim];
    int               strides[dim]; ///< of cell numbers along each axis
    int               along;        ///< the axis along which they follow each other

    UNDINE_HOST_DEVICE
    int
    n_cells() const
    {
      int product = 1;
      for (int axis = 0; axis < dim; ++axis)
        product *= cells[axis];
      return product;
    }

    /// The shortest vector to x from y across periodic boundaries [m].
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    difference(const Vector<dim, Real> &x, const Vector<dim, Real> &y) const
    {
      Vector<dim, Real> result = x - y;
      for (int axis = 0; axis < dim; ++axis)
        if (periodic[axis])
          {
            if (2 * result[axis] > size[axis])
              result[axis] -= size[axis];
            else if (2 * result[axis] < -size[axis])
              result[axis] += size[axis];
          }
      return result;
    }

    /// Can there be something across a periodic boundary within the reach of x?
    UNDINE_HOST_DEVICE
    bool
    is_beside_periodic_side(const Vector<dim, Real> &x, const Real reach) const
    {
      bool result = false;
      for (int axis = 0; axis < dim; ++axis)
        {
          const Real from_lower = x[axis] - lower[axis];
          result =
            result || (periodic[axis] && (from_lower < reach || size[axis] - from_lower < reach));
        }
      return result;
    }

    /// Back into the box across periodic boundaries, however far x has gone.
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    wrapped(Vector<dim, Real> x) const
    {
      for (int axis = 0; axis < dim; ++axis)
        if (periodic[axis])
          {
            // By whole periods, at least one: rounding must leave nothing on the wrong side.
            if (x[axis] < lower[axis])
              x[axis] +=
                size[axis] * maximum(Real(1), std::ceil((lower[axis] - x[axis]) / size[axis]));
            else if (!(x[axis] < lower[axis] + size[axis]))
              x[axis] -=
                size[axis] * maximum(Real(1), std::floor((x[axis] - lower[axis]) / size[axis]));
          }
      return x;
    }

    UNDINE_HOST_DEVICE
    bool
    contains(const Vector<dim, Real> &x) const
    {
      bool inside = true;
      for (int axis = 0; axis < dim; ++axis)
        inside = inside && x[axis] >= lower[axis] && x[axis] <= lower[axis] + size[axis];
      return inside;
    }

    /// Along one axis; what is outside counts to the outermost cells, not-a-number to the first.
    UNDINE_HOST_DEVICE
    int
    coordinate(const Vector<dim, Real> &x, const int axis) const
    {
      const Real place = (x[axis] - lower[axis]) * inverse_cell[axis];
      // No grid has as many cells as this bound, and an integer holds it.
      const Real bounded = minimum(maximum(Real(0), place), Real(1 << 30));
      return minimum(static_cast<int>(bounded), cells[axis] - 1);
    }

    UNDINE_HOST_DEVICE
    int
    index(const int (&coordinates)[dim]) const
    {
      int result = 0;
      for (int axis = 0; axis < dim; ++axis)
        result += coordinates[axis] * strides[axis];
      return result;
    }

    UNDINE_HOST_DEVICE
    int
    cell_of(const Vector<dim, Real> &x) const
    {
      int coordinates[dim];
      for (int axis = 0; axis < dim; ++axis)
        coordinates[axis] = coordinate(x, axis);
      return index(coordinates);
    }

    /// Call f(begin, end, y) for runs of consecutive cells which together are the cell of x and all
    /// around it, each once, in a fixed order. Seen from there, across periodic boundaries, x is at
    /// y.
    template <class Function>
    UNDINE_HOST_DEVICE
    void
    for_each_run_around(const Vector<dim, Real> &x, const Function &f) const
    {
      int  rows = 1, here = 0, length = 0;
      bool wraps  = false;
      Real period = 0;
      for (int axis = 0; axis < dim; ++axis)
        if (axis == along)
          {
            here   = coordinate(x, axis);
            length = cells[axis];
            wraps  = periodic[axis];
            period = size[axis];
          }
        else
          rows *= 3;
      for (int row = 0; row < rows; ++row)
        {
          int  first = 0, rest = row;
          bool exists = true;
          auto y      = x;
          for (int axis = 0; axis < dim; ++axis)
            {
              if (axis == along)
                continue;
              int cell = coordinate(x, axis) + rest % 3 - 1;
              rest /= 3;
              if (periodic[axis] && cell < 0)
                {
                  cell += cells[axis];
                  y[axis] += size[axis];
                }
              else if (periodic[axis] && cell >= cells[axis])
                {
                  cell -= cells[axis];
                  y[axis] -= size[axis];
                }
              exists = exists && cell >= 0 && cell < cells[axis];
              first += cell * strides[axis];
            }
          if (!exists)
            continue;
          f(first + maximum(here - 1, 0), first + minimum(here + 1, length - 1) + 1, y);
          if (wraps && here == 0)
            f(first + length - 1, first + length, shifted_along(y, period));
          if (wraps && here == length - 1)
            f(first, first + 1, shifted_along(y, -period));
        }
    }

  private:
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    shifted_along(Vector<dim, Real> x, const Real distance) const
    {
      for (int axis = 0; axis < dim; ++axis)
        if (axis == along)
          x[axis] += distance;
      return x;
    }
  };

  /// The box from `lower` to `upper` [m] in cells of at least `reach` [m]. Throws InputError if it
  /// is empty or has less than three cells along a periodic axis.
  template <int dim, class Real>
  CellGrid<dim, Real>
  make_cell_grid(const Vector<dim, double> &lower,
                 const Vector<dim, double> &upper,
                 const bool (&periodic)[dim],
                 double reach);
} // namespace undine::particles

#endif
