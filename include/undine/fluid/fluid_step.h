// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_fluid_step_h
#define undine_fluid_fluid_step_h

#include <undine/base/core/timing.h>
#include <undine/fluid/fluid_model.h>
#include <undine/fluid/fluid_state.h>

namespace undine
{
  /// What the effects work on while the fluid goes from t^n to t^{n+1}: they turn state.velocity
  /// from v^n into v*, which the projection then makes divergence-free.
  template <int dim>
  struct FluidStep
  {
    const FluidModel<dim> &model;
    FluidState<dim>       &state;
    double                 time; ///< t^n [s]
    double                 dt;   ///< h [s]
    TimingTree            &timing;
    unsigned int           linear_iterations = 0; ///< summed over implicit solves
  };
} // namespace undine

#endif
