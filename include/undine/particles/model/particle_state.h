// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_model_particle_state_h
#define undine_particles_model_particle_state_h

#include <undine/particles/model/particle.h>

#include <map>
#include <string>
#include <vector>

namespace undine::particles
{
  /// All particles as plain data, in the order of the last sort; a saved copy restarts a run.
  template <int dim>
  struct ParticleState
  {
    std::vector<Vector<dim, double>> positions;  ///< [m]
    std::vector<Vector<dim, double>> velocities; ///< [m/s]
    std::vector<double>              pressures;  ///< beyond pressure_at_rest() [Pa]
    std::vector<Tag>                 tags;
    /// Unique; 0 ... n_solid - 1 belong to elastic bodies. Material k + 1 is body k, 0 the fluid
    /// and the walls.
    std::vector<int> identities;

    /// Of the particles of bodies, by identity, where the domain has periodic sides: places as they
    /// would be had they never been put back through those, so that bodies are whole [m]. Empty: as
    /// `positions` say.
    std::vector<Vector<dim, double>> body_points;

    /// What the method remembers besides, in an order of its own: guesses for its solvers, and what
    /// elastic bodies carry. May be empty.
    std::vector<double> guesses;

    /// What particles of fluid carry, by the fields' names and identities. Engines leave it as it
    /// is.
    std::map<std::string, std::vector<double>> scalars;
  };


  /// How far the particle at place k of the arrays, which is one of a body, is from a place of its
  /// reference [m], as often as it may have gone through periodic sides.
  template <int dim>
  Vector<dim, double>
  displacement(const ParticleState<dim>  &state,
               const std::size_t          k,
               const Vector<dim, double> &reference)
  {
    const auto &x =
      state.body_points.empty() ? state.positions[k] : state.body_points[state.identities[k]];
    return x - reference;
  }
} // namespace undine::particles

#endif
