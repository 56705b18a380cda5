// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_engine_state_transfer_h
#define undine_particles_engine_state_transfer_h

#include <undine/particles/elasticity/elastic_arrays.h>
#include <undine/particles/engine/particle_arrays.h>
#include <undine/particles/model/particle_state.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace undine::particles
{
  /// What elastic bodies remember besides places and velocities. Calls f(buffer) for each array.
  template <class Executor, int dim, class Real, class Function>
  void
  for_each_memory(ElasticArrays<Executor, dim, Real> &bodies, const Function &f)
  {
    f(bodies.rotations);
    f(bodies.carried);
  }

  /// The numbers in an array of numbers, vectors or matrices.
  template <class Real, class T>
  std::vector<double>
  flattened(const std::vector<T> &values)
  {
    std::vector<Real> numbers(values.size() * sizeof(T) / sizeof(Real));
    if (!numbers.empty())
      std::memcpy(numbers.data(), values.data(), numbers.size() * sizeof(Real));
    return {numbers.begin(), numbers.end()};
  }

  /// Take an array of `values.size()` objects from the front of `numbers`, at `position`.
  template <class Real, class T>
  void
  unflatten(std::vector<T> &values, const std::vector<double> &numbers, std::size_t &position)
  {
    std::vector<Real> part(values.size() * sizeof(T) / sizeof(Real));
    for (Real &number : part)
      number = static_cast<Real>(numbers[position++]);
    if (!part.empty())
      std::memcpy(values.data(), part.data(), part.size() * sizeof(Real));
  }


  /// Fill arrays where an executor works with a state; places beyond those of the state are parked.
  template <class Executor, int dim, class Real>
  void
  take_state(ParticleArrays<Executor, dim, Real> &arrays,
             ElasticArrays<Executor, dim, Real>  &bodies,
             const ParticleState<dim>            &state)
  {
    const std::size_t                    n_state = state.positions.size(), n = arrays.places.size();
    std::vector<Place<dim, Real>>        places(n, {Vector<dim, Real>::zero(), Tag::parked()});
    std::vector<Motion<dim, Real>>       motions(n, {Vector<dim, Real>::zero(), Real(0)});
    std::vector<ElasticPoint<dim, Real>> points(bodies.n);
    std::vector<int>                     identities = state.identities;
    for (std::size_t i = 0; i < n_state; ++i)
      {
        places[i]  = {converted<dim, Real>(state.positions[i]), state.tags[i]};
        motions[i] = {converted<dim, Real>(state.velocities[i]),
                      static_cast<Real>(state.pressures[i])};
        if (state.identities[i] < bodies.n)
          points[state.identities[i]] = {places[i].x, motions[i].v};
      }
    int next = n_state == 0 ? 0 : *std::max_element(identities.begin(), identities.end()) + 1;
    while (identities.size() < n)
      identities.push_back(next++);
    for (std::size_t k = 0; k < state.body_points.size(); ++k)
      points[k].x = converted<dim, Real>(state.body_points[k]);
    arrays.places.set(places);
    arrays.motions.set(motions);
    arrays.identities.set(identities);
    bodies.points.set(points);
    bodies.deformations.set(
      std::vector<Matrix<dim, Real>>(bodies.n, Matrix<dim, Real>::diagonal(1)));
    if (state.guesses.empty())
      return;
    std::size_t position = 0;
    const auto  take     = [&](auto &buffer) {
      auto values = buffer.values();
      unflatten<Real>(values, state.guesses, position);
      buffer.set(values);
    };
    std::vector<StoredVector<dim, Real>> potentials(n_state);
    for (auto &potential : potentials)
      for (int axis = 0; axis < dim; ++axis)
        potential.entries[axis] = static_cast<Real>(state.guesses[position++]);
    arrays.potentials.set(potentials);
    for_each_memory(bodies, take);
  }


  /// Copy arrays where an executor works into a state.
  template <class Executor, int dim, class Real>
  void
  give_state(ParticleState<dim>                        &state,
             const ParticleArrays<Executor, dim, Real> &arrays,
             ElasticArrays<Executor, dim, Real>        &bodies)
  {
    const auto places = arrays.places.values();
    // Parked particles are the last ones.
    const std::size_t n = std::find_if(places.begin(),
                                       places.end(),
                                       [](const auto &place) { return place.tag.is_parked(); }) -
                          places.begin();
    const auto motions = arrays.motions.values();
    state.identities   = arrays.identities.values();
    state.identities.resize(n);
    state.positions.resize(n);
    state.velocities.resize(n);
    state.pressures.resize(n);
    state.tags.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      {
        state.positions[i]  = converted<dim, double>(places[i].x);
        state.velocities[i] = converted<dim, double>(motions[i].v);
        state.pressures[i]  = motions[i].pressure;
        state.tags[i]       = places[i].tag;
      }
    const auto potentials = arrays.potentials.values();
    state.guesses.clear();
    for (std::size_t i = 0; i < n; ++i)
      state.guesses.insert(state.guesses.end(), potentials[i].entries, potentials[i].entries + dim);
    for_each_memory(bodies, [&](auto &buffer) {
      const auto more = flattened<Real>(buffer.values());
      state.guesses.insert(state.guesses.end(), more.begin(), more.end());
    });
  }


  /// ParticleState::body_points.
  template <class Executor, int dim, class Real>
  std::vector<Vector<dim, double>>
  points_of_bodies(const ElasticArrays<Executor, dim, Real> &bodies)
  {
    std::vector<Vector<dim, double>> result;
    for (const auto &point : bodies.points.values())
      result.push_back(converted<dim, double>(point.x));
    return result;
  }


  /// A copy of what a frame changes, to go back to.
  template <class Executor, int dim, class Real>
  class Snapshot
  {
  public:
    Snapshot(Executor &executor, const int n, const int n_solid, const int n_bodies)
      : executor(executor)
      , particles(executor, n)
      , points(executor, n_solid)
      , rotations(executor, n_solid)
      , carried(executor, n_bodies)
    {
    }

    void
    save(const ParticleArrays<Executor, dim, Real> &arrays,
         const ElasticArrays<Executor, dim, Real>  &bodies)
    {
      copy(particles, arrays);
      copy(points, bodies.points);
      copy(rotations, bodies.rotations);
      copy(carried, bodies.carried);
    }

    void
    restore(ParticleArrays<Executor, dim, Real> &arrays,
            ElasticArrays<Executor, dim, Real>  &bodies) const
    {
      copy(arrays, particles);
      copy(bodies.points, points);
      copy(bodies.rotations, rotations);
      copy(bodies.carried, carried);
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

    Executor                                 &executor;
    ParticleArrays<Executor, dim, Real>       particles;
    Buffer<Executor, ElasticPoint<dim, Real>> points;
    Buffer<Executor, Matrix<dim, Real>>       rotations;
    Buffer<Executor, Real>                    carried;
  };
} // namespace undine::particles

#endif
