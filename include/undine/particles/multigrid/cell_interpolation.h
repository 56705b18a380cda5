// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_multigrid_cell_interpolation_h
#define undine_particles_multigrid_cell_interpolation_h

#include <undine/particles/model/cell_grid.h>
#include <undine/particles/multigrid/stencil_grid.h>

namespace undine::particles
{
  /// Where a particle is in its cell, from -1/2 to 1/2 along each axis, in ten bits each.
  template <int dim, class Real>
  struct PlaceInCell
  {
    int bits;

    static constexpr int largest = (1 << 10) - 1;

    UNDINE_HOST_DEVICE
    static PlaceInCell
    of(const CellGrid<dim, Real> &cells, const Vector<dim, Real> &x)
    {
      PlaceInCell result = {0};
      for (int axis = 0; axis < dim; ++axis)
        {
          const Real from_lower = (x[axis] - cells.lower[axis]) * cells.inverse_cell[axis] -
                                  static_cast<Real>(cells.coordinate(x, axis));
          const Real share = minimum(maximum(from_lower, Real(0)), Real(1));
          result.bits |= static_cast<int>(share * largest + Real(0.5)) << (10 * axis);
        }
      return result;
    }

    UNDINE_HOST_DEVICE
    Real
    along(const int axis) const
    {
      return static_cast<Real>(bits >> (10 * axis) & largest) * (Real(1) / largest) - Real(0.5);
    }
  };

  /// A function in a cell: its value at the centre and its slopes over the cell's length. Also what
  /// is dual to it: the sum of numbers of particles, and that of numbers times places in the cell.
  template <int dim, class Real>
  struct alignas(4 * sizeof(Real)) LinearInCell
  {
    Real              value;
    Vector<dim, Real> slopes;

    UNDINE_HOST_DEVICE
    static LinearInCell
    zero()
    {
      return {0, Vector<dim, Real>::zero()};
    }

    UNDINE_HOST_DEVICE
    Real
    at(const PlaceInCell<dim, Real> &place) const
    {
      Real sum = value;
      for (int axis = 0; axis < dim; ++axis)
        sum += slopes[axis] * place.along(axis);
      return sum;
    }

    UNDINE_HOST_DEVICE
    void
    add(const Real number, const PlaceInCell<dim, Real> &place)
    {
      value += number;
      for (int axis = 0; axis < dim; ++axis)
        slopes[axis] += number * place.along(axis);
    }
  };

  /// Between numbers of cells and functions that are linear in each cell with the slopes of central
  /// differences, where a cell without unknowns has the number of its neighbour.
  template <int dim, class Real>
  struct CellInterpolation
  {
    StencilGrid<dim>         grid;
    LinearInCell<dim, Real> *functions;

    /// In a cell with the index `index`, from the numbers of cells.
    UNDINE_HOST_DEVICE
    LinearInCell<dim, Real>
    function(const StencilCell<dim> &cell, const int index, const Real *numbers) const
    {
      LinearInCell<dim, Real> result;
      result.value = numbers[index];
      for (int axis = 0; axis < dim; ++axis)
        result.slopes[axis] =
          (numbers[cell.has_next(axis, 1) ? next(cell, index, axis, 1) : index] -
           numbers[cell.has_next(axis, -1) ? next(cell, index, axis, -1) : index]) /
          2;
      return result;
    }

    /// The transpose: a cell's number from the sums in it and around it.
    UNDINE_HOST_DEVICE
    Real
    number(const StencilCell<dim> &cell, const int index) const
    {
      const LinearInCell<dim, Real> own = functions[index];
      Real                          sum = 0;
      for (int axis = 0; axis < dim; ++axis)
        {
          sum += cell.has_next(axis, -1) ? functions[next(cell, index, axis, -1)].slopes[axis]
                                         : -own.slopes[axis];
          sum -= cell.has_next(axis, 1) ? functions[next(cell, index, axis, 1)].slopes[axis]
                                        : -own.slopes[axis];
        }
      return own.value + sum / 2;
    }

  private:
    UNDINE_HOST_DEVICE
    int
    next(const StencilCell<dim> &cell, const int index, const int axis, const int step) const
    {
      const int c = cell.coordinates[axis];
      return index + (grid.next_to(c, step, axis) - c) * grid.strides[axis];
    }
  };
} // namespace undine::particles

#endif
