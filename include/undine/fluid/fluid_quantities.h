// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_fluid_quantities_h
#define undine_fluid_fluid_quantities_h

#include <undine/base/core/column.h>
#include <undine/fluid/fluid_model.h>
#include <undine/fluid/fluid_state.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace undine
{
  /// Numbers that describe a whole flow. All are collective and equal on all ranks. @{

  /// sum_f rho V_f v_f^2 / 2 over faces, [J] (per metre in 2D).
  template <int dim>
  double
  kinetic_energy(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// sum_f rho V_f v_f of the faces normal to each axis, [kg m/s] (per metre in 2D).
  template <int dim>
  dealii::Tensor<1, dim>
  linear_momentum(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// Largest |v_f| of the faces normal to each axis, [m/s]. Throws SolveError if one is not finite.
  template <int dim>
  dealii::Tensor<1, dim>
  largest_components(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// Largest |v| in the cells' centres, [m/s]. Throws SolveError if not finite.
  template <int dim>
  double
  largest_speed(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// V_c / dx_c [m^(dim-1)] with the smallest width of the cell: a flux of U times this is a
  /// dimensionless divergence of 1.
  template <int dim>
  double
  flux_area(const MacGrid<dim> &grid, const GridIndex<dim> &cell);

  /// max over cells of |(D v)_c| / flux_area, [m/s], from the result of divergence().
  template <int dim>
  double
  largest_divergence(const FluidModel<dim> &model, const Field<dim> &fluxes);

  /// The same for a velocity.
  template <int dim>
  double
  largest_divergence(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// Volume that leaves through each boundary of model.boundaries().all(), [m^dim/s].
  template <int dim>
  std::vector<double>
  boundary_fluxes(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// What is wrong with the fluxes through the boundaries of a domain without opening, or "".
  template <int dim>
  std::string
  net_flux_complaint(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// Integral of p n over each boundary, n out of the fluid: the force of the (reduced) pressure on
  /// it, [N]. The pressure is continued linearly from the two nearest cells, but not next to
  /// bodies.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  pressure_forces(const FluidModel<dim> &model, const FluidState<dim> &state);

  /// Friction of a fluid of the given dynamic viscosity [Pa s] on each boundary, [N].
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  viscous_forces(const FluidModel<dim> &model,
                 const FluidState<dim> &state,
                 const double           dynamic_viscosity,
                 const double           time);

  /// Integral of a cell field over the domain, [unit m^dim].
  template <int dim>
  double
  integral(const FluidModel<dim> &model, const Field<dim> &scalar);

  /// What the fluid adds to the file `statistics`; `divergence` [1] as the projection left it.
  template <int dim>
  Columns
  fluid_columns(const FluidModel<dim> &model,
                const FluidState<dim> &state,
                const double           divergence);
  /// @}

  /// "Force on lid, x" and so on, for walls only.
  template <int dim>
  Columns
  force_columns(const std::string                         &what,
                const FluidModel<dim>                     &model,
                const std::vector<dealii::Tensor<1, dim>> &forces);
} // namespace undine

#endif
