// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_nearest_of_edges_h
#define undine_surface_nearest_of_edges_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace undine
{
  /// The points of two edges x0 x1 and x2 x3 that are nearest to each other.
  template <int dim>
  struct NearestOfEdges
  {
    std::array<double, 2>  parts;        ///< of the segments from x0 to x1 and from x2 to x3 [1]
    std::array<bool, 2>    inside;       ///< is it neither end?
    dealii::Tensor<1, dim> from;         ///< point of the first less that of the second [m]
    double                 distance = 0; ///< [m]
  };

  /// For parallel edges an end of one and its nearest point on the other. `x` [m].
  template <int dim>
  NearestOfEdges<dim>
  nearest_of_edges(const std::array<dealii::Point<dim>, 4> &x);
} // namespace undine

#endif
