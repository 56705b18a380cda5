// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/grid_planes.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  template <int dim>
  GridPlanes<dim>::GridPlanes(const std::array<std::vector<double>, dim> &positions)
    : planes(positions)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double lower = planes[d].front(), upper = planes[d].back();
        const double largest = std::max(std::abs(lower), std::abs(upper));
        mean_width[d]        = (upper - lower) / n_cells(d);
        for (int cell = 0; cell < n_cells(d); ++cell)
          rounding_levels[d].push_back(8 * std::numeric_limits<double>::epsilon() *
                                       std::max(16., largest / width(d, cell)));
      }
  }


  template <int dim>
  int
  GridPlanes<dim>::slab(const unsigned int axis, const double coordinate) const
  {
    const auto &p = planes[axis];
    if (coordinate <= p.front())
      return -1;
    if (coordinate >= p.back())
      return n_cells(axis);
    // On equal distances the guess is right but for rounding.
    const int guess =
      std::min(static_cast<int>((coordinate - p.front()) / mean_width[axis]), n_cells(axis) - 1);
    for (int cell = std::max(0, guess - 1); cell <= std::min(guess + 1, n_cells(axis) - 1); ++cell)
      if (p[cell] <= coordinate && coordinate < p[cell + 1])
        return cell;
    return slab_between(axis, coordinate, -1, n_cells(axis));
  }


  template <int dim>
  int
  GridPlanes<dim>::slab_between(const unsigned int axis,
                                const double       coordinate,
                                const int          lowest,
                                const int          highest) const
  {
    if (lowest < 0 && coordinate <= planes[axis].front())
      return lowest;
    const auto begin = planes[axis].begin() + (lowest + 1);
    const auto end   = planes[axis].begin() + (highest + 1);
    return lowest + static_cast<int>(std::upper_bound(begin, end, coordinate) - begin);
  }


  template class GridPlanes<2>;
  template class GridPlanes<3>;
} // namespace undine
