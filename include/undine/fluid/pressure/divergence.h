// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_divergence_h
#define undine_fluid_pressure_divergence_h

#include <undine/fluid/model/fluid_model.h>

namespace undine
{
  /// (D v)_c = sum_f +-a_f v_f over the faces of every owned cell, or over the pieces of faces
  /// around every component (F2), (I1): the volume that leaves it [m^dim/s]; zero in bodies. One
  /// ghost layer of the velocity must be up to date.
  template <int dim>
  Field<dim>
  divergence(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// V_c / dx_c [m^(dim-1)] with the smallest width of the cell: a flux of U times this is a
  /// dimensionless divergence of 1.
  template <int dim>
  double
  flux_area(const MacGrid<dim> &grid, const GridIndex<dim> &cell);

  /// max over cells of |(D v)_c| / flux_area [m/s], from the result of divergence(). Collective.
  /// Throws SolveError if a value is not finite.
  template <int dim>
  double
  largest_divergence(const FluidModel<dim> &model, const Field<dim> &fluxes);

  /// The same for a velocity, whose ghost values need not be up to date. Collective.
  template <int dim>
  double
  largest_divergence(const FluidModel<dim> &model, const Velocity<dim> &velocity);
} // namespace undine

#endif
