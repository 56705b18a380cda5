// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_setup_disorder_h
#define undine_particles_setup_disorder_h

#include <undine/particles/model/particle_state.h>
#include <undine/particles/setup/setup.h>

namespace undine::particles
{
  /// Moves the fluid of a full domain by up to a tenth of a spacing along each axis, each particle
  /// to a place of its own that is always the same: a flow would stretch the rows of a perfect
  /// lattice until they break all at once. Other states stay as they are.
  template <int dim>
  void
  disorder(const Setup<dim> &setup, ParticleState<dim> &state);
} // namespace undine::particles

#endif
