// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_fluid_patches_h
#define undine_output_fluid_patches_h

#include <undine/fluid/fluid_model.h>
#include <undine/fluid/fluid_state.h>
#include <undine/output/patches.h>

namespace undine
{
  /// The fluid at `time` [s]: patches of one or several cells of this rank with the values in the
  /// cells' corners (FluidSampler): velocity [m/s], reduced pressure [Pa], magnitude of the
  /// vorticity [1/s] and every scalar. Collective.
  template <int dim>
  Patches<dim>
  fluid_patches(const FluidModel<dim> &model, const FluidState<dim> &state, double time);
} // namespace undine

#endif
