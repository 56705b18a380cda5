// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_convection_short_waves_h
#define undine_fluid_convection_short_waves_h

#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/model/fluid_model.h>

namespace undine
{
  /// Take away from `velocity` what a flow damps in `dt` [s] of waves that central fluxes carry
  /// upstream (F22). A wave of the length lambda on cells of the width dx goes with
  /// u cos(2 pi dx / lambda): one that is shorter than four cells comes back from where it has
  /// arisen, as in vortices that arrive at wider cells, and stays around bodies. In each direction
  ///
  ///     V_g dv_g/dt = -sum_f dD_f/dv_g V_f K_f D_f,
  ///     K_f = min(|u_f| / (16 dx), 1 / (32 dim dt)) min(1, max(0, -(D_f- + D_f+) / (2 D_f)))
  ///
  /// with the second differences D_f around the places f, between f- and f+. In a wave the last
  /// factor is -cos(2 pi dx / lambda): there is none for four cells and more, and the dissipation
  /// of QUICK (Leonard, Comput. Methods Appl. Mech. Eng. 19, 1979) for two. Linear velocities and
  /// momentum stay, energy falls. Places whose face or next ones are cut have no D_f, and faces on
  /// sides of the domain keep their velocity.
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
