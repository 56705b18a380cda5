// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_index_box_h
#define undine_fluid_grid_index_box_h

#include <algorithm>
#include <cstddef>

namespace undine
{
  /// Indices of a grid point, one a direction; in periodic directions any whole number is valid.
  template <int dim>
  struct GridIndex
  {
    int values[dim]; ///< bare, so that {{1, 2}} is one

    int &
    operator[](const unsigned int direction)
    {
      return values[direction];
    }

    int
    operator[](const unsigned int direction) const
    {
      return values[direction];
    }

    bool
    operator==(const GridIndex &other) const
    {
      return std::equal(values, values + dim, other.values);
    }

    /// Lexicographic, for lists with keys.
    bool
    operator<(const GridIndex &other) const
    {
      return std::lexicographical_compare(values, values + dim, other.values, other.values + dim);
    }
  };

  /// The same number in all directions.
  template <int dim>
  GridIndex<dim>
  all_directions(const int number)
  {
    GridIndex<dim> result;
    std::fill_n(result.values, dim, number);
    return result;
  }

  /// `index` moved by `distance` along `axis`.
  template <int dim>
  inline GridIndex<dim>
  moved(GridIndex<dim> index, const unsigned int axis, const int distance)
  {
    index[axis] += distance;
    return index;
  }

  /// The points with lower[d] <= i_d < upper[d] in every direction d.
  template <int dim>
  struct IndexBox
  {
    GridIndex<dim> lower{};
    GridIndex<dim> upper{};

    /// Is there no point in it?
    bool
    empty() const
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (upper[d] <= lower[d])
          return true;
      return false;
    }

    /// Number of points.
    std::size_t
    size() const
    {
      std::size_t product = 1;
      for (unsigned int d = 0; d < dim; ++d)
        product *= std::max(0, upper[d] - lower[d]);
      return product;
    }

    bool
    contains(const GridIndex<dim> &index) const
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (index[d] < lower[d] || index[d] >= upper[d])
          return false;
      return true;
    }

    /// Position of `index` when the points are listed with the first direction running fastest.
    std::size_t
    position(const GridIndex<dim> &index) const
    {
      std::size_t result = 0;
      for (unsigned int d = dim; d-- > 0;)
        result = result * (upper[d] - lower[d]) + (index[d] - lower[d]);
      return result;
    }

    /// The box with `width` more points on either side.
    IndexBox
    grown(const GridIndex<dim> &width) const
    {
      IndexBox result = *this;
      for (unsigned int d = 0; d < dim; ++d)
        {
          result.lower[d] -= width[d];
          result.upper[d] += width[d];
        }
      return result;
    }

    /// The points that are in both boxes.
    IndexBox
    intersection(const IndexBox &other) const
    {
      IndexBox result;
      for (unsigned int d = 0; d < dim; ++d)
        {
          result.lower[d] = std::max(lower[d], other.lower[d]);
          result.upper[d] = std::min(upper[d], other.upper[d]);
        }
      return result;
    }

    bool
    operator==(const IndexBox &other) const
    {
      return lower == other.lower && upper == other.upper;
    }
  };

  /// Call `action(index)` for every point of the box, the first direction running fastest.
  template <int dim, class Action>
  void
  for_each(const IndexBox<dim> &box, Action &&action)
  {
    if (box.empty())
      return;
    GridIndex<dim> index = box.lower;
    unsigned int   d     = 0;
    while (d < dim)
      {
        for (index[0] = box.lower[0]; index[0] < box.upper[0]; ++index[0])
          action(static_cast<const GridIndex<dim> &>(index));
        for (d = 1; d < dim; ++d)
          {
            if (++index[d] < box.upper[d])
              break;
            index[d] = box.lower[d];
          }
      }
  }

  /// Call action(index of the first point, number of points) for every row of points of a box along
  /// the first direction: within it, the values of fields lie side by side.
  template <int dim, class Action>
  void
  for_each_row(IndexBox<dim> box, const Action &action)
  {
    const int n  = box.upper[0] - box.lower[0];
    box.upper[0] = box.lower[0] + std::min(1, n);
    for_each(box, [&](const GridIndex<dim> &first) { action(first, n); });
  }
} // namespace undine

#endif
