// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_fields_fluid_patches_h
#define undine_output_fields_fluid_patches_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>
#include <undine/output/fields/patches.h>

namespace undine
{
  /// The fluid: patches of one or several cells of this rank with the values in the
  /// cells' corners (FluidSampler): velocity [m/s], reduced pressure [Pa], magnitude of the
  /// vorticity [1/s] and every scalar.
  ///
  /// If bodies stand in the fluid: one patch for each component of a divided cell, with the values
  /// at its centroid in corners that are not visible from there; in bodies the velocity of the
  /// nearest surface and zeros. Then there are also the number of the component in its cell (-1 in
  /// bodies) and the share of the cell that is fluid of this component [1]. Collective.
  template <int dim>
  Patches<dim>
  fluid_patches(const Models<dim> &models, const State<dim> &state);
} // namespace undine

#endif
