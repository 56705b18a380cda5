// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_coupled_particle_run_h
#define undine_tests_coupled_particle_run_h

#include <undine/coupled/scheme/particle_scheme.h>

#include <particle_model/particle_scene.h>

#include <memory>
#include <string>

namespace undine_tests
{
  /// A scene of particles and its run.
  template <int dim>
  struct ParticleRun
  {
    explicit ParticleRun(const std::string &text)
      : options(read_scene_text(text))
    {
      models.effects = make_effects<dim>(options);
      models.particles =
        std::make_unique<const ParticleModel<dim>>(options, models.effects, MPI_COMM_SELF);
      scheme.add_options(options);
      state.clock.end_time = 1e6;
      report               = scheme.initialize(state, models, timing);
    }

    void
    advance(const unsigned int frames)
    {
      for (unsigned int k = 0; k < frames; ++k)
        {
          const double dt = scheme.choose_dt(state);
          report          = scheme.step(state, dt);
          state.clock.advance(dt);
        }
    }

    /// The last value of a column.
    double
    column(const std::string &name) const
    {
      for (const auto &column : report.columns)
        if (column.name == name)
          return column.value;
      throw std::runtime_error("no column '" + name + "'");
    }

    Options             options;
    Models<dim>         models;
    ParticleScheme<dim> scheme;
    State<dim>          state;
    TimingTree          timing;
    Report              report;
  };
} // namespace undine_tests

#endif
