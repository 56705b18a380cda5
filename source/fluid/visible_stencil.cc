// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/visible_stencil.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// The polynomial through n points, at x.
    double
    continued(const double *places, const double *values, const unsigned int n, const double x)
    {
      double sum = 0;
      for (unsigned int i = 0; i < n; ++i)
        {
          double weight = 1;
          for (unsigned int j = 0; j < n; ++j)
            if (j != i)
              weight *= (x - places[j]) / (places[i] - places[j]);
          sum += weight * values[i];
        }
      return sum;
    }
  } // namespace


  template <int dim>
  VisibleStencil<dim>::VisibleStencil(const Lattice<dim>       &lattice,
                                      const dealii::Point<dim> &place)
  {
    strides[0] = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        rows[d] = lattice.row(d).stencil(place[d]);
        for (unsigned int k = 0; k < rows[d].n_points; ++k)
          places[d][k] = lattice.row(d).position(rows[d].first + static_cast<int>(k));
        strides[d + 1] = strides[d] * rows[d].n_points;
      }
    size = strides[dim];
    std::fill_n(known.begin(), size, false);
  }


  template <int dim>
  GridIndex<dim>
  VisibleStencil<dim>::index_of(const unsigned int k) const
  {
    GridIndex<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = rows[d].first + static_cast<int>(k / strides[d] % rows[d].n_points);
    return result;
  }


  template <int dim>
  GridIndex<dim>
  VisibleStencil<dim>::lower() const
  {
    return index_of(0);
  }


  template <int dim>
  GridIndex<dim>
  VisibleStencil<dim>::upper() const
  {
    return index_of(size - 1);
  }


  template <int dim>
  void
  VisibleStencil<dim>::note(const unsigned int k, const double value)
  {
    values[k] = value;
    known[k]  = true;
    smallest  = std::min(smallest, value);
    largest   = std::max(largest, value);
  }


  template <int dim>
  void
  VisibleStencil<dim>::fill_line(const unsigned int first, const unsigned int axis)
  {
    const unsigned int          n = rows[axis].n_points;
    std::array<unsigned int, 4> seen{};
    unsigned int                n_seen = 0;
    for (unsigned int k = 0; k < n; ++k)
      if (known[first + k * strides[axis]])
        seen[n_seen++] = k;
    if (n_seen == 0 || n_seen == n)
      return;
    for (unsigned int k = 0; k < n; ++k)
      if (!known[first + k * strides[axis]])
        {
          auto       nearest  = seen;
          const auto distance = [&](const unsigned int j) {
            return std::abs(static_cast<int>(j) - static_cast<int>(k));
          };
          std::stable_sort(nearest.begin(), nearest.begin() + n_seen, [&](const auto a, const auto b) {
            return distance(a) < distance(b);
          });
          std::array<double, 4> x{}, y{};
          for (unsigned int j = 0; j < n_seen; ++j)
            {
              x[j] = places[axis][nearest[j]];
              y[j] = values[first + nearest[j] * strides[axis]];
            }
          values[first + k * strides[axis]] =
            continued(x.data(), y.data(), std::min(n_seen, 3u), places[axis][k]);
        }
    for (unsigned int k = 0; k < n; ++k)
      known[first + k * strides[axis]] = true;
  }


  template <int dim>
  void
  VisibleStencil<dim>::fill_along(const unsigned int axis)
  {
    for (unsigned int k = 0; k < size; ++k)
      if (k / strides[axis] % rows[axis].n_points == 0)
        fill_line(k, axis);
  }


  template <int dim>
  std::optional<double>
  VisibleStencil<dim>::value()
  {
    if (smallest > largest)
      return {};
    for (unsigned int axis = 0; axis < dim; ++axis)
      fill_along(axis);
    double sum = 0;
    for (unsigned int k = 0; k < size; ++k)
      {
        double weight = 1;
        for (unsigned int d = 0; d < dim; ++d)
          weight *= rows[d].weights[k / strides[d] % rows[d].n_points];
        sum += weight * values[k];
      }
    return std::clamp(sum, smallest, largest);
  }


  template class VisibleStencil<2>;
  template class VisibleStencil<3>;
} // namespace undine
