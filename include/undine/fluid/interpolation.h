// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_interpolation_h
#define undine_fluid_interpolation_h

#include <undine/fluid/field.h>

#include <deal.II/base/point.h>

namespace undine
{
  /// A value and the bounds of the samples around its place.
  struct BoundedValue
  {
    double value;
    double smallest;
    double largest;
  };

  /// Multilinear interpolation at a place whose surrounding points are stored; exact for
  /// multilinear functions on graded lattices too. Places outside the domain count as the nearest
  /// inside.
  template <int dim>
  double
  interpolate(const Field<dim> &field, const dealii::Point<dim> &place);

  /// The same, with the smallest and the largest of the 2^dim samples.
  template <int dim>
  BoundedValue
  interpolate_with_bounds(const Field<dim> &field, const dealii::Point<dim> &place);

  /// Interpolation by the cubic polynomials through four points in each direction; the bounds are
  /// those of the 2^dim samples around the place, which the value may exceed.
  template <int dim>
  BoundedValue
  interpolate_cubic(const Field<dim> &field, const dealii::Point<dim> &place);
} // namespace undine

#endif
