// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_setup_check_state_h
#define undine_particles_setup_check_state_h

#include <undine/particles/model/particle_state.h>
#include <undine/particles/setup/setup.h>

namespace undine::particles
{
  /// Throws InputError, naming particles and places, if a state cannot be computed with: arrays of
  /// different lengths, identities or bodies that do not fit the setup, numbers that are not
  /// finite, particles outside the box, at a start two particles closer than half a spacing.
  template <int dim>
  void
  check_state(const Setup<dim> &setup, const ParticleState<dim> &state);
} // namespace undine::particles

#endif
