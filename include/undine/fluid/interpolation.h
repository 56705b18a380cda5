// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_interpolation_h
#define undine_fluid_interpolation_h

#include <undine/fluid/field.h>

#include <deal.II/base/point.h>

namespace undine
{
  /// A value and the bounds of the samples it was made of.
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
} // namespace undine

#endif
