// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_particle_arrays_h
#define undine_output_particle_arrays_h

#include <undine/output/hdf5_file.h>
#include <undine/output/state_arrays.h>
#include <undine/particles/particle_state.h>

#include <vector>

namespace undine
{
  /// All particles as arrays of a checkpoint, in the order in which the state has them.
  template <int dim>
  std::vector<StateArray>
  pack_particles(const particles::ParticleState<dim> &state);

  /// The reverse. `arrays` are those of pack_particles() for a state of as many particles and
  /// guesses.
  template <int dim>
  void
  unpack_particles(particles::ParticleState<dim> &state, const std::vector<StateArray> &arrays);

  /// Make room for as many guesses as a checkpoint has: their number is the solvers' affair.
  template <int dim>
  void
  resize_guesses(particles::ParticleState<dim> &state, const HDF5Reader &file);
} // namespace undine

#endif
