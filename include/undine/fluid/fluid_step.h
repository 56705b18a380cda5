// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_fluid_step_h
#define undine_fluid_fluid_step_h

#include <undine/base/core/timing.h>
#include <undine/fluid/flow.h>
#include <undine/fluid/fluid_model.h>
#include <undine/fluid/fluid_state.h>

#include <deal.II/base/tensor.h>

namespace undine
{
  /// What the effects work on while the fluid goes from t^n to t^{n+1}: they turn state.velocity
  /// from v^n into v*, which the projection then makes divergence-free:
  ///
  ///  1. transport:  v' = v^n carried along v^n                               (class Advection)
  ///  2. accelerate: v'' = v' + h f
  ///  3. diffuse:    (1 - h nu Laplace) w = v'' - h grad p^n / rho,  v* = w + h grad p^n / rho
  ///  4. project:    v^{n+1} = v* - h grad p^{n+1} / rho,  div v^{n+1} = 0    (class Projection)
  ///
  /// The old pressure gradient that 3 borrows and gives back lets friction see the flow that will
  /// be left after 4 instead of one that still slips along walls. In this way a steady flow solves
  /// its equations with an error of second order in space, and of first order in h through 1 only.
  /// First order in time; stable for every h without forces, whatever the Courant number.
  template <int dim>
  struct FluidStep
  {
    /// Freezes v^n. Collective.
    FluidStep(const FluidModel<dim>        &model,
              FluidState<dim>              &state,
              const dealii::Tensor<1, dim> &gravity,
              const double                  time,
              const double                  dt,
              TimingTree                   &timing);

    const FluidModel<dim>       &model;
    FluidState<dim>             &state;
    const dealii::Tensor<1, dim> gravity; ///< uniform acceleration, in the reduced pressure [m/s^2]
    const double                 time;    ///< t^n [s]
    const double                 dt;      ///< h [s]
    TimingTree                  &timing;
    const Flow<dim>              flow;                  ///< v^n, which carries everything
    unsigned int                 linear_iterations = 0; ///< summed over implicit solves
  };
} // namespace undine

#endif
