// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_checkpoint_particle_arrays_h
#define undine_output_checkpoint_particle_arrays_h

#include <undine/output/checkpoint/state_arrays.h>
#include <undine/output/files/hdf5_reader.h>
#include <undine/particles/model/particle_state.h>

#include <vector>

namespace undine
{
  /// All particles as arrays of a checkpoint, in the order in which the state has them, and their
  /// spacing [m].
  template <int dim>
  std::vector<StateArray>
  pack_particles(const particles::ParticleState<dim> &state, double spacing);

  /// Set the state from `arrays`, those of pack_particles() for a state of as many particles and
  /// guesses.
  template <int dim>
  void
  unpack_particles(particles::ParticleState<dim> &state, const std::vector<StateArray> &arrays);

  /// Make room for as many particles and guesses as a checkpoint has: particles flow in and out,
  /// and guesses are the solvers' affair. Throws FileError if it has none, or of another spacing.
  template <int dim>
  void
  resize_particles(particles::ParticleState<dim> &state, double spacing, const HDF5Reader &file);

  /// The particles of bodies and walls, which neither come nor go.
  template <int dim>
  std::size_t
  count_lasting_particles(const particles::ParticleState<dim> &state);
} // namespace undine

#endif
