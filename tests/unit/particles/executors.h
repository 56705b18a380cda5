// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_unit_particles_executors_h
#define undine_tests_unit_particles_executors_h

#include "particle_scene.h"

#include <catch2/catch.hpp>

/// Runs on several executors.
namespace particle_tests
{
  template <int dim>
  std::unique_ptr<Engine<dim>>
  engine_on(const std::string &executor, const ParticleScene<dim> &scene)
  {
    auto engine =
      Registry<EngineFactory<dim>>::instance().make(executor)->make(Precision::single_precision, 0);
    engine->load(scene.setup, scene.state);
    return engine;
  }

  template <int dim>
  bool
  has_device()
  {
    const auto factory = Registry<EngineFactory<dim>>::instance().make("device");
    return factory->reason_not_available(0).empty();
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
} // namespace particle_tests

#endif
