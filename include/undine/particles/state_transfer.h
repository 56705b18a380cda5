// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_state_transfer_h
#define undine_particles_state_transfer_h

#include <undine/particles/elastic_arrays.h>
#include <undine/particles/particle_arrays.h>
#include <undine/particles/particle_state.h>

namespace undine::particles
{
  template <int dim, class To, class From>
  Vector<dim, To>
  converted(const Vector<dim, From> &from)
  {
    Vector<dim, To> to;
    for (int axis = 0; axis < dim; ++axis)
      to[axis] = static_cast<To>(from[axis]);
    return to;
  }

  /// Fill arrays where an executor works with a state.
  template <class Executor, int dim, class Real>
  void
  take_state(ParticleArrays<Executor, dim, Real> &arrays,
             ElasticArrays<Executor, dim, Real>  &bodies,
             const ParticleState<dim>            &state)
  {
    const std::size_t              n = state.positions.size();
    std::vector<Place<dim, Real>>  places(n);
    std::vector<Motion<dim, Real>> motions(n);
    std::vector<Vector<dim, Real>> potentials(n, Vector<dim, Real>::zero());
    std::vector<Vector<dim, Real>> x(bodies.n), v(bodies.n);
    for (std::size_t i = 0; i < n; ++i)
      {
        places[i]  = {converted<dim, Real>(state.positions[i]), state.tags[i]};
        motions[i] = {converted<dim, Real>(state.velocities[i]),
                      static_cast<Real>(state.pressures[i])};
        if (state.identities[i] < bodies.n)
          {
            x[state.identities[i]] = places[i].x;
            v[state.identities[i]] = motions[i].v;
          }
        if (state.guesses.size() == n * dim)
          for (int axis = 0; axis < dim; ++axis)
            potentials[i][axis] = static_cast<Real>(state.guesses[i * dim + axis]);
      }
    arrays.places.set(places);
    arrays.motions.set(motions);
    arrays.identities.set(state.identities);
    arrays.potentials.set(potentials);
    bodies.x.set(x);
    bodies.v.set(v);
    bodies.deformations.set(
      std::vector<Matrix<dim, Real>>(bodies.n, Matrix<dim, Real>::diagonal(1)));
  }


  /// Copy arrays where an executor works into a state.
  template <class Executor, int dim, class Real>
  void
  give_state(ParticleState<dim> &state, const ParticleArrays<Executor, dim, Real> &arrays)
  {
    const auto        places     = arrays.places.values();
    const auto        motions    = arrays.motions.values();
    const auto        potentials = arrays.potentials.values();
    const std::size_t n          = places.size();
    state.identities             = arrays.identities.values();
    state.positions.resize(n);
    state.velocities.resize(n);
    state.pressures.resize(n);
    state.tags.resize(n);
    state.guesses.resize(n * dim);
    for (std::size_t i = 0; i < n; ++i)
      {
        state.positions[i]  = converted<dim, double>(places[i].x);
        state.velocities[i] = converted<dim, double>(motions[i].v);
        state.pressures[i]  = motions[i].pressure;
        state.tags[i]       = places[i].tag;
        for (int axis = 0; axis < dim; ++axis)
          state.guesses[i * dim + axis] = potentials[i][axis];
      }
  }


  /// A copy of what a frame changes, to go back to.
  template <class Executor, int dim, class Real>
  class Snapshot
  {
  public:
    Snapshot(Executor &executor, const int n, const int n_solid)
      : executor(executor)
      , particles(executor, n)
      , x(executor, n_solid)
      , v(executor, n_solid)
      , rotations(executor, n_solid)
    {
    }

    void
    save(const ParticleArrays<Executor, dim, Real> &arrays,
         const ElasticArrays<Executor, dim, Real>  &bodies)
    {
      copy(particles, arrays);
      copy(x, bodies.x);
      copy(v, bodies.v);
      copy(rotations, bodies.rotations);
    }

    void
    restore(ParticleArrays<Executor, dim, Real> &arrays,
            ElasticArrays<Executor, dim, Real>  &bodies) const
    {
      copy(arrays, particles);
      copy(bodies.x, x);
      copy(bodies.v, v);
      copy(bodies.rotations, rotations);
    }

  private:
    template <class T>
    void
    copy(Buffer<Executor, T> &to, const Buffer<Executor, T> &from) const
    {
      executor.duplicate(to.data(), from.data(), from.size());
    }

    void
    copy(ParticleArrays<Executor, dim, Real>       &to,
         const ParticleArrays<Executor, dim, Real> &from) const
    {
      copy(to.places, from.places);
      copy(to.motions, from.motions);
      copy(to.identities, from.identities);
      copy(to.potentials, from.potentials);
    }

    Executor                           &executor;
    ParticleArrays<Executor, dim, Real> particles;
    Buffer<Executor, Vector<dim, Real>> x, v;
    Buffer<Executor, Matrix<dim, Real>> rotations;
  };
} // namespace undine::particles

#endif
