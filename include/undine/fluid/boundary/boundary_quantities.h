// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_boundary_boundary_quantities_h
#define undine_fluid_boundary_boundary_quantities_h

#include <undine/base/core/column.h>
#include <undine/fluid/boundary/boundary_map.h>
#include <undine/fluid/grid/fluid_state.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace undine
{
  /// Fluxes through the boundaries of the domain and forces on them. All are collective and equal
  /// on all ranks. @{

  /// Volume that leaves through each boundary of boundaries.all(), [m^dim/s].
  template <int dim>
  std::vector<double>
  boundary_fluxes(const BoundaryMap<dim> &boundaries, const Velocity<dim> &velocity);

  /// A message if the net flux through the boundaries of a domain without opening is not zero, else
  /// "".
  template <int dim>
  std::string
  net_flux_complaint(const BoundaryMap<dim> &boundaries, const Velocity<dim> &velocity);

  /// Integral of (p + weight.x) n over each boundary, n out of the fluid: the force of the pressure
  /// on it, [N], where p is reduced by that of the fluid's own `weight`, rho g [N/m^dim]. The
  /// reduced pressure is continued linearly from the two nearest cells, but not next to bodies.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  pressure_forces(const BoundaryMap<dim>       &boundaries,
                  const FluidState<dim>        &state,
                  const dealii::Tensor<1, dim> &weight);

  /// Friction of a fluid of the given dynamic viscosity [Pa s] on each boundary, [N].
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  viscous_forces(const BoundaryMap<dim> &boundaries,
                 const FluidState<dim>  &state,
                 const double            dynamic_viscosity,
                 const double            time);

  /// What sides whose velocity along them is prescribed do to the fluid by its friction: moving
  /// walls, as a rule, [W].
  template <int dim>
  double
  viscous_power(const BoundaryMap<dim> &boundaries,
                const FluidState<dim>  &state,
                const double            dynamic_viscosity,
                const double            time);

  /// The columns "Force on lid, x" and so on [N], `what` being their first words; for walls only.
  template <int dim>
  Columns
  force_columns(const std::string                         &what,
                const BoundaryMap<dim>                    &boundaries,
                const std::vector<dealii::Tensor<1, dim>> &forces);
  /// @}
} // namespace undine

#endif
