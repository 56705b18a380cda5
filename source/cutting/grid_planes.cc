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


  template <int dim>
  GridBlock<dim>::GridBlock(std::shared_ptr<const GridPlanes<dim>> planes,
                            const IndexBox<dim>                   &owned,
                            const int                              halo)
    : grid_planes(planes)
    , owned_cells(owned)
  {
    IndexBox<dim> whole;
    for (unsigned int d = 0; d < dim; ++d)
      whole.upper[d] = grid_planes->n_cells(d);
    all_cells = owned.grown(all_directions<dim>(halo)).intersection(whole);
    all_nodes = all_cells;
    for (int &end : all_nodes.upper.values)
      ++end;
  }


  template <int dim>
  double
  GridBlock<dim>::cell_volume(const GridIndex<dim> &cell) const
  {
    double volume = 1;
    for (unsigned int d = 0; d < dim; ++d)
      volume *= grid_planes->width(d, cell[d]);
    return volume;
  }


  template <int dim>
  double
  GridBlock<dim>::face_area(const unsigned int axis, const GridIndex<dim> &face) const
  {
    double area = 1;
    for (unsigned int d = 0; d < dim; ++d)
      if (d != axis)
        area *= grid_planes->width(d, face[d]);
    return area;
  }


  template <int dim>
  double
  GridBlock<dim>::rounding(const GridIndex<dim> &cell) const
  {
    double level = 0;
    for (unsigned int d = 0; d < dim; ++d)
      level = std::max(level, grid_planes->rounding(d, cell[d]));
    return level;
  }


  template class GridPlanes<2>;
  template class GridPlanes<3>;
  template class GridBlock<2>;
  template class GridBlock<3>;
} // namespace undine
