// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_fluid_step_h
#define undine_fluid_fluid_step_h

#include <undine/base/core/timing.h>
#include <undine/fluid/flow.h>
#include <undine/fluid/fluid_model.h>
#include <undine/fluid/fluid_state.h>

#include <deal.II/base/tensor.h>

#include <optional>

namespace undine
{
  /// What the effects work on while the fluid goes from t^n to t^{n+1}: they turn state.velocity
  /// from v^n into v*, which the projection then makes divergence-free:
  ///
  ///  1. transport:  v' = A(v^n + c h a^n) - c h a^n,  A: carried along v^n         (Advection)
  ///  2. accelerate: v'' = v' + h f
  ///  3. diffuse:    (1 - h nu Laplace) w = v'' - h grad q^n / rho,  v* = w + h grad q^n / rho
  ///  4. project:    v^{n+1} = v* - h grad p^{n+1} / rho,  div v^{n+1} = 0         (Projection)
  ///  5. finish:     a^{n+1} = (v^{n+1} - v') / h,  q^{n+1} = p^{n+1} - mu div w
  ///
  /// First order in time: forces act at t^{n+1} as a whole, which damps, and pressure is one
  /// impulse h p. Steady flows, however, hardly depend on h, by two corrections of higher order:
  ///
  /// Friction sees the flow that will be left after 4, not one that still slips along walls: step 3
  /// borrows the old pressure gradient and gives it back, the incremental pressure correction in
  /// its rotational form (Guermond, Minev & Shen 2006). q is the state's pressure.
  ///
  /// The share c of the parcels' acceleration a is carried along in 1. In a steady flow c = 1/2
  /// would be the trapezoidal rule along their paths: v + h a / 2 at the foot is v - h a / 2 at the
  /// head. A force -lambda v then multiplies v by (A - (A - 1) c z) / (1 + z) in a step, z = h
  /// lambda: up to 2 c for stiff friction and A = -1. c = 0.45 keeps that below one and takes away
  /// nine tenths of the error of first order in h.
  template <int dim>
  struct FluidStep
  {
    static constexpr double carried_share = 0.45; ///< c

    /// Freezes v^n. What bodies leave of the grid may have changed since then: velocity and scalars
    /// follow when they are carried, pressure and acceleration here. Collective.
    FluidStep(const FluidModel<dim>            &model,
              FluidState<dim>                  &state,
              const dealii::Tensor<1, dim>     &gravity,
              const double                      time,
              const double                      dt,
              TimingTree                       &timing,
              const typename Flow<dim>::Bodies &bodies = {});

    /// Bring what no effect has carried to what bodies leave of the grid now: it stays where it
    /// was.
    void
    settle();

    /// Ends the step, after the projection: acceleration and pressure for the next one.
    void
    finish() const;

    const FluidModel<dim>       &model;
    FluidState<dim>             &state;
    const dealii::Tensor<1, dim> gravity; ///< uniform acceleration, in the reduced pressure [m/s^2]
    const double                 time;    ///< t^n [s]
    const double                 dt;      ///< h [s]
    TimingTree                  &timing;
    const Flow<dim>              flow;                  ///< v^n, which carries everything
    unsigned int                 linear_iterations = 0; ///< summed over implicit solves

    /// What effects leave for finish(). @{
    std::optional<Velocity<dim>> carried;             ///< v' [m/s], by convection
    std::optional<Field<dim>>    pressure_correction; ///< -mu div w [Pa], by viscosity
    /// @}
  };
} // namespace undine

#endif
