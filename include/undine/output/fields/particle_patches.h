// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_fields_particle_patches_h
#define undine_output_fields_particle_patches_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>
#include <undine/output/fields/patches.h>

namespace undine
{
  /// All particles as points, those of walls only if the scene wants it: velocity [m/s],
  /// displacement of bodies' particles since rest [m] (zero of others), pressure [Pa], kind (0
  /// fluid, 1 body, 2 wall, 3 inside of a wall), number of the body (-1: none) and identity.
  template <int dim>
  Patches<0, dim>
  particle_patches(const ParticleModel<dim> &model, const particles::ParticleState<dim> &state);
} // namespace undine

#endif
