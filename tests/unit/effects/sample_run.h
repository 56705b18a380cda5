// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_effects_sample_run_h
#define undine_tests_effects_sample_run_h

#include <undine/scene/scene.h>

#include <effects/flow_run.h>

namespace undine_tests
{
  /// A whole plane scene, step by step, as the program reads it.
  struct SampleRun
  {
    explicit SampleRun(const std::string &text)
      : options(read_scene_text("set Dimension = 2\n" + text))
      , scene(read_scene<2>(options, MPI_COMM_WORLD))
    {
      state.clock = scene.clock;
      report      = scene.scheme->initialize(state, scene.models, timing);
    }

    void
    step()
    {
      report = scene.scheme->step(state, scene.scheme->choose_dt(state));
      state.clock.advance(report.dt);
    }

    bool
    has(const std::string &name) const
    {
      return std::any_of(report.columns.begin(), report.columns.end(), [&](const auto &column) {
        return column.name == name;
      });
    }

    double
    column(const std::string &name) const
    {
      for (const auto &column : report.columns)
        if (column.name == name)
          return column.value;
      throw std::runtime_error("no column " + name);
    }

    const Options options;
    TimingTree    timing;
    Scene<2>      scene;
    State<2>      state;
    Report        report;
  };


  /// All numbers of this rank that make up a state, without what exists for one effect only.
  inline std::vector<double>
  numbers_of(const State<2> &state)
  {
    std::vector<double> all;
    const auto          add = [&](const std::vector<double> &more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    const auto add_field = [&](const Field<2> &field) {
      if (!field.shared_lattice())
        return;
      add(field.owned_values());
      add(field.parts());
    };
    for (const auto *velocity : {&state.fluid.velocity, &state.fluid.acceleration})
      for (const auto &component : velocity->components)
        add_field(component);
    add_field(state.fluid.pressure);
    for (const auto *vector :
         {&state.solid.displacement, &state.solid.velocity, &state.solid.acceleration})
      if (vector->size() > 0)
        add(std::vector<double>(vector->begin(), vector->end()));
    for (const auto *vectors : {&state.particles.positions, &state.particles.velocities})
      for (const auto &vector : *vectors)
        add({vector[0], vector[1]});
    return all;
  }
} // namespace undine_tests

#endif
