// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_engine_particle_arrays_h
#define undine_particles_engine_particle_arrays_h

#include <undine/particles/execution/buffer.h>
#include <undine/particles/model/particle.h>

namespace undine::particles
{
  /// The memory of Particles.
  template <class Executor, int dim, class Real>
  struct ParticleArrays
  {
    ParticleArrays(const Executor &executor, const int n)
      : places(executor, n)
      , motions(executor, n)
      , identities(executor, n)
      , potentials(executor, n)
    {
    }

    Particles<dim, Real>
    view() const
    {
      return {static_cast<int>(places.size()),
              places.data(),
              motions.data(),
              identities.data(),
              potentials.data()};
    }

    Buffer<Executor, Place<dim, Real>>        places;
    Buffer<Executor, Motion<dim, Real>>       motions;
    Buffer<Executor, int>                     identities;
    Buffer<Executor, StoredVector<dim, Real>> potentials;
  };
} // namespace undine::particles

#endif
