// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_convection_short_waves_h
#define undine_fluid_convection_short_waves_h

#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/model/fluid_model.h>

namespace undine
{
  /// Take away from `velocity` what a flow damps in `dt` [s] of waves that are too short for
  /// central fluxes (F22). These carry a wave of the length lambda on cells of the width dx with
  /// u cos(2 pi dx / lambda), those shorter than four cells upstream: they come back from where
  /// they have arisen, as where vortices arrive at wider cells, and stay around bodies. In each
  /// direction
  ///
  ///     V_g dv_g/dt = -sum_m dT_m/dv_g V_m K_m T_m,
  ///     K_m = min(|u_m| / (60 dx), 1 / (128 dim dt))
  ///
  /// with the third differences T_m in the middles m between places. That is the dissipation of
  /// upwind fluxes of fifth order (Wicker, Skamarock, Mon. Weather Rev. 130, 2002). Linear
  /// velocities and momentum stay, energy falls. There is no T_m if one of the four places is cut,
  /// and faces on sides of the domain keep their velocity.
  ///
  /// `flow` has a ghost layer and is that at the end of `dt`. Collective.
  template <int dim>
  void
  damp_short_waves(const FluidModel<dim> &model,
                   const Velocity<dim>   &flow,
                   double                 dt,
                   Velocity<dim>         &velocity);
} // namespace undine

#endif
