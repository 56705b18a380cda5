// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_pressure_balance_h
#define undine_fluid_pressure_pressure_balance_h

#include <undine/fluid/pressure/pressure_gradient.h>

#include <vector>

namespace undine
{
  /// The energy and momentum that the impulses h p of a step give to the fluid, each term from its
  /// own formula. Sums run over faces and pieces, n points out of the fluid, Gamma are the surfaces
  /// in it:
  ///
  ///     momentum = sum rho V (v^{n+1} - v*) = - h (sides + openings + int_Gamma p n)
  ///     sum rho V (|v^{n+1}|^2 - |v*|^2)/2  = h (power of sides + of openings - p.B w) - loss
  template <int dim>
  struct PressureBalance
  {
    dealii::Tensor<1, dim> momentum;              ///< [kg m/s]
    dealii::Tensor<1, dim> sides;                 ///< sum a p n where the velocity is given [N]
    dealii::Tensor<1, dim> openings;              ///< sum a p n where the pressure is [N]
    double                 power_of_sides    = 0; ///< - sum a p v.n [W]
    double                 power_of_openings = 0; ///< [W]
    double                 loss              = 0; ///< sum rho V |v^{n+1} - v*|^2/2 [J]
    double                 energy_before     = 0; ///< of v* [J]
    double                 energy_after      = 0; ///< of v^{n+1} [J]
    dealii::Tensor<1, dim> momentum_before;       ///< of v* [kg m/s]
  };

  /// The balance of the change from v* = `before`, with the velocity on walls and inflows in place,
  /// to v^{n+1} = `after` by `pressure`; `openings` with the pressures that have acted. Collective.
  template <int dim>
  PressureBalance<dim>
  pressure_balance(const FluidModel<dim>            &model,
                   const Velocity<dim>              &before,
                   const Velocity<dim>              &after,
                   const Field<dim>                 &pressure,
                   const std::vector<OpenFace<dim>> &openings);
} // namespace undine

#endif
