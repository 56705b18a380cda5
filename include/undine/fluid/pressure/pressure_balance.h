// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_pressure_balance_h
#define undine_fluid_pressure_pressure_balance_h

#include <undine/fluid/pressure/pressure_gradient.h>

#include <vector>

namespace undine
{
  /// The forces and the power of the impulses h p of a step on the sides of the domain, with the
  /// velocity v that they lead to. Sums run over faces and pieces, n points out of the fluid, Gamma
  /// are the surfaces in it, which move with w:
  ///
  ///     sum rho V (v - v*)     = - h (sides + openings + int_Gamma p n)
  ///     sum rho V v . (v - v*) = h (power of sides + of openings - p . B w)
  template <int dim>
  struct PressureBalance
  {
    dealii::Tensor<1, dim> sides;                 ///< sum a p n where the velocity is given [N]
    dealii::Tensor<1, dim> openings;              ///< sum a p n where the pressure is [N]
    double                 power_of_sides    = 0; ///< - sum a p v.n [W]
    double                 power_of_openings = 0; ///< [W]
    double                 mean_at_openings  = 0; ///< of the pressure, over their area [Pa]

    /// What flows in, - sum a v.n: the power of a pressure of 1 Pa [m^dim/s]. @{
    double inflow_of_sides    = 0;
    double inflow_of_openings = 0;
    /// @}
  };

  /// Of `pressure`, which has led to `velocity`; `openings` with the pressures that have acted.
  /// Collective.
  template <int dim>
  PressureBalance<dim>
  pressure_balance(const FluidModel<dim>            &model,
                   const Velocity<dim>              &velocity,
                   const Field<dim>                 &pressure,
                   const std::vector<OpenFace<dim>> &openings);
} // namespace undine

#endif
