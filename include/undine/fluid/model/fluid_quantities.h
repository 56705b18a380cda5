// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_model_fluid_quantities_h
#define undine_fluid_model_fluid_quantities_h

#include <undine/base/core/column.h>
#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/model/fluid_model.h>

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

  /// sum_f rho V_f v_f w_f over faces, of velocities on the same topology [J] (per metre in 2D).
  template <int dim>
  double
  inner_product(const FluidModel<dim> &model, const Velocity<dim> &v, const Velocity<dim> &w);

  /// The kinetic energy that leaves the domain with the flow, sum a v.n rho |v|^2 / 2 over the
  /// faces of its sides, n out of the fluid; negative where more enters [W].
  template <int dim>
  double
  kinetic_energy_outflow(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// rho |v|^2 / 2 in the components of divided cells, [open->cells] of the velocity's topology, of
  /// this rank: v_f^2 in the mean over the open areas of each direction [Pa]. Empty where nothing
  /// is divided.
  template <int dim>
  std::vector<double>
  kinetic_energy_densities(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// sum_f rho V_f v_f of the faces normal to each axis, [kg m/s] (per metre in 2D).
  template <int dim>
  dealii::Tensor<1, dim>
  linear_momentum(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// Throws SolveError, which names the velocity, unless `finite` on all ranks.
  void
  throw_unless_finite(const bool finite, const MPI_Comm communicator);

  /// Largest |v_f| of the faces normal to each axis, [m/s]. Throws SolveError if one is not finite.
  template <int dim>
  dealii::Tensor<1, dim>
  largest_components(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// Largest |v| in the cells' centres, [m/s]. Throws SolveError if not finite.
  template <int dim>
  double
  largest_speed(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// Integral of a cell field over the domain, [unit m^dim].
  template <int dim>
  double
  integral(const FluidModel<dim> &model, const Field<dim> &scalar);

  /// The columns of the fluid for the file `statistics`; `gravity` [m/s^2] is what its pressure is
  /// reduced by, `divergence` [1] as the projection left it.
  template <int dim>
  Columns
  fluid_columns(const FluidModel<dim>        &model,
                const FluidState<dim>        &state,
                const dealii::Tensor<1, dim> &gravity,
                const double                  divergence);
  /// @}
} // namespace undine

#endif
