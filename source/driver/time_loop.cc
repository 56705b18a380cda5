// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/parallel/interruption.h>
#include <undine/coupled/step/physics.h>
#include <undine/driver/measured_costs.h>
#include <undine/driver/progress.h>
#include <undine/driver/time_loop.h>

#include <optional>

namespace undine
{
  namespace
  {
    template <int dim>
    void
    write_outputs(const State<dim> &state,
                  const Report     &report,
                  Scene<dim>       &scene,
                  TimingTree       &timing)
    {
      const auto timed = timing.section("output");
      for (auto &output : scene.outputs)
        if (output->due(state.clock))
          output->write(state, report);
    }


    /// A step, with what probes say of its end. If one of them fails the state is again that before
    /// the step: the rows that have been written must lead up to it.
    template <int dim>
    Report
    make_step(State<dim> &state, Scene<dim> &scene, TimingTree &timing)
    {
      std::optional<State<dim>> before;
      if (!scene.probes.empty())
        before = state;
      Report report = scene.scheme->step(state, scene.scheme->choose_dt(state));
      state.clock.advance(report.dt); // what was accepted; retries happen inside step
      try
        {
          ask_probes(report, state, scene, timing);
        }
      catch (const Error &)
        {
          state = *before;
          throw;
        }
      return report;
    }
  } // namespace


  template <int dim>
  void
  ask_probes(Report &report, const State<dim> &state, const Scene<dim> &scene, TimingTree &timing)
  {
    const auto timed = timing.section("measure");
    for (const auto &probe : scene.probes)
      append(report.columns, probe->columns(scene.models, state));
  }


  template <int dim>
  void
  run_time_loop(
    State<dim> &state, Scene<dim> &scene, const Watch<dim> &watch, Log &log, TimingTree &timing)
  {
    Progress      progress(log, state.clock);
    MeasuredCosts costs(log, state.clock, scene.models.communicator());
    scene.scheme->follow([&](const std::string &how_far) {
      progress.within_step(how_far);
      return !interruption_requested();
    });
    listen_for_interruption();
    while (!state.clock.ended())
      {
        throw_if_interrupted(scene.models.communicator());
        const Report report = make_step(state, scene, timing);
        if (report.steady)
          state.clock.end_time = state.clock.time;
        watch.step(state, report);
        write_outputs(state, report, scene, timing);
        watch.outputs(state);
        progress.report(state.clock, report);
        costs.observe(state.clock);
        if (report.steady)
          log.print("steady: of late fluid and bodies have changed by {:.2g} of what they are",
                    *report.steady);
      }
  }


#define UNDINE_INSTANTIATE(dim)                                                             \
  template void ask_probes(Report &, const State<dim> &, const Scene<dim> &, TimingTree &); \
  template void run_time_loop(State<dim> &, Scene<dim> &, const Watch<dim> &, Log &, TimingTree &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
