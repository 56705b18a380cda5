// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_grid_planes_h
#define undine_cutting_grid_planes_h

#include <array>
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
} // namespace undine

#endif
