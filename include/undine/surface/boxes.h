// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_boxes_h
#define undine_surface_boxes_h

#include <deal.II/base/bounding_box.h>

#include <array>

namespace undine
{
  /// The box around places, wider by `thickness` on all sides [m]. @{
  template <int dim, std::size_t n>
  dealii::BoundingBox<dim>
  box_around(const std::array<dealii::Point<dim>, n> &points, const double thickness)
  {
    dealii::BoundingBox<dim> result(points);
    result.extend(thickness);
    return result;
  }

  template <int dim>
  dealii::BoundingBox<dim>
  box_around(const dealii::Point<dim> &point, const double thickness)
  {
    return box_around(std::array<dealii::Point<dim>, 1>{{point}}, thickness);
  }

  template <int dim>
  dealii::BoundingBox<dim>
  box_around(const dealii::Point<dim> &a, const dealii::Point<dim> &b, const double thickness)
  {
    return box_around(std::array<dealii::Point<dim>, 2>{{a, b}}, thickness);
  }
  /// @}

  /// Have two boxes a point in common?
  template <int dim>
  bool
  meet(const dealii::BoundingBox<dim> &a, const dealii::BoundingBox<dim> &b)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (a.lower_bound(d) > b.upper_bound(d) || b.lower_bound(d) > a.upper_bound(d))
        return false;
    return true;
  }
} // namespace undine

#endif
