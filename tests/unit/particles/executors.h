// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_unit_particles_executors_h
#define undine_tests_unit_particles_executors_h

#include "particle_scene.h"

#include <catch2/catch.hpp>

/// Runs on several executors and differences between them.
namespace particle_tests
{
  template <int dim>
  std::unique_ptr<Engine<dim>>
  engine_on(const std::string &executor, const ParticleScene<dim> &scene)
  {
    auto engine =
      Registry<EngineFactory<dim>>::instance().make(executor)->make(Precision::single_precision);
    engine->load(scene.setup, scene.state);
    return engine;
  }

  template <int dim>
  bool
  has_device()
  {
    const auto factory = Registry<EngineFactory<dim>>::instance().make("device");
    return factory->reason_not_available().empty();
  }

  /// True where there is no device, which is said.
  template <int dim>
  bool
  is_skipped()
  {
    if (!has_device<dim>())
      WARN("skipped: there is no device to compare with");
    return !has_device<dim>();
  }

  template <int dim>
  std::vector<std::string>
  executors()
  {
    return has_device<dim>() ? std::vector<std::string>{"host", "device"}
                             : std::vector<std::string>{"host"};
  }

  template <int dim>
  ParticleState<dim>
  state_of(const Engine<dim> &engine)
  {
    ParticleState<dim> state;
    engine.fetch(state);
    return state;
  }

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
} // namespace particle_tests

#endif
