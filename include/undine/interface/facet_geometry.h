// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_interface_facet_geometry_h
#define undine_interface_facet_geometry_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace undine
{
  /// Corners of a segment in the plane or a triangle in space.
  template <int dim>
  using FacetNodes = std::array<dealii::Point<dim>, dim>;

  /// The share of the way from `from` to `to` at which it comes within `thickness` [m] of a facet's
  /// plane and its rims; infinity if it does not. Facets without area are never met: their
  /// neighbours cover them.
  template <int dim>
  double
  first_hit(const FacetNodes<dim>    &facet,
            const dealii::Point<dim> &from,
            const dealii::Point<dim> &to,
            const double              thickness);

  /// The point of a facet that is nearest to a place, by its barycentric coordinates. @{
  std::array<double, 2>
  nearest_point(const FacetNodes<2> &facet, const dealii::Point<2> &place);
  std::array<double, 3>
  nearest_point(const FacetNodes<3> &facet, const dealii::Point<3> &place);
  /// @}

  /// Whether a place lies in one of the simplices that a facet passes over while its nodes move
  /// straight on from `before` to `after`, or within `thickness` [m] of it. `order` of the nodes'
  /// numbers, lowest first: it makes the simplices of neighbouring facets fit each other.
  template <int dim>
  bool
  passes_over(const FacetNodes<dim>               &before,
              const FacetNodes<dim>               &after,
              const std::array<unsigned int, dim> &order,
              const dealii::Point<dim>            &place,
              const double                         thickness);
} // namespace undine

#endif
