// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_interpolation_h
#define undine_fluid_grid_interpolation_h

#include <undine/fluid/grid/fluid_state.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace undine
{
  /// A value and the bounds of the samples around its place.
  struct BoundedValue
  {
    double value;
    double smallest;
    double largest;
  };

  /// Multilinear interpolation at a place [m] whose surrounding points are stored; exact for
  /// multilinear functions on graded lattices too. Places outside the domain count as the nearest
  /// inside. Bodies are not regarded (see VisibleSamples).
  template <int dim>
  double
  interpolate(const Field<dim> &field, const dealii::Point<dim> &place);

  /// The same of all components of a velocity.
  template <int dim>
  dealii::Tensor<1, dim>
  interpolate(const Velocity<dim> &velocity, const dealii::Point<dim> &place);

  /// Multilinear interpolation of a field, with the smallest and the largest of the 2^dim samples.
  template <int dim>
  BoundedValue
  interpolate_with_bounds(const Field<dim> &field, const dealii::Point<dim> &place);

  /// What becomes of values of a polynomial beyond those of the samples next to the place.
  enum class Overshoot
  {
    kept,
    clipped ///< to the bounds of the 2^dim samples around the place
  };

  /// Interpolation by the cubic polynomials through four points in each direction: the weights for
  /// one place [m], which serve all fields with the same lattice and the same stored points.
  template <int dim>
  class CubicInterpolation
  {
  public:
    CubicInterpolation(const Field<dim> &like, const dealii::Point<dim> &place);

    double
    value(const Field<dim> &field, const Overshoot overshoot) const;

  private:
    dealii::Point<dim>            place;
    std::array<Row::Stencil, dim> stencils;
    GridIndex<dim>                begin;
    bool                          is_complete; ///< with four points in each direction
  };

  /// The same for one field.
  template <int dim>
  double
  interpolate_cubic(const Field<dim>         &field,
                    const dealii::Point<dim> &place,
                    const Overshoot           overshoot);
} // namespace undine

#endif
