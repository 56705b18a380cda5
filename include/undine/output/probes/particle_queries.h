// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_probes_particle_queries_h
#define undine_output_probes_particle_queries_h

#include <undine/particle_model/particle_model.h>
#include <undine/particles/model/particle_state.h>

#include <deal.II/base/point.h>

#include <vector>

namespace undine
{
  /// Position in the arrays of a state of the particle with this identity.
  template <int dim>
  std::size_t
  place_of_identity(const particles::ParticleState<dim> &state, const int identity);

  /// Identity of the particle of body number `body` that rests nearest to `place` [m].
  template <int dim>
  int
  nearest_of_body(const ParticleModel<dim> &model, const int body, const dealii::Point<dim> &place);

  /// The fluid particles of the largest part that hangs together: no gap wider than `gap` [m].
  /// Numbers of particles in the state.
  template <int dim>
  std::vector<std::size_t>
  main_part_of_fluid(const particles::ParticleState<dim> &state, const double gap);
} // namespace undine

#endif
