// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_unit_particles_state_differences_h
#define undine_tests_unit_particles_state_differences_h

#include "particle_scene.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace particle_tests
{
  /// The state of each identity.
  template <int dim>
  std::vector<std::size_t>
  places_by_identity(const ParticleState<dim> &state)
  {
    std::vector<std::size_t> result(state.identities.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      result[state.identities[i]] = i;
    return result;
  }

  /// Largest distance of a particle from itself in another state [m].
  template <int dim>
  double
  largest_distance(const ParticleState<dim> &a, const ParticleState<dim> &b)
  {
    const auto at = places_by_identity(a), bt = places_by_identity(b);
    double     largest = 0;
    for (std::size_t identity = 0; identity < at.size(); ++identity)
      largest =
        std::max(largest, norm_square(a.positions[at[identity]] - b.positions[bt[identity]]));
    return std::sqrt(largest);
  }

  /// The largest difference over the largest value.
  inline double
  relative_difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    double difference = 0, largest = 0;
    for (std::size_t i = 0; i < b.size(); ++i)
      {
        difference = std::max(difference, std::abs(a[i] - b[i]));
        largest    = std::max(largest, std::abs(b[i]));
      }
    return largest > 0 ? difference / largest : difference;
  }
} // namespace particle_tests

#endif
