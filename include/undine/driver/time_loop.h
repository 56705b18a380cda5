// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_time_loop_h
#define undine_driver_time_loop_h

#include <undine/driver/log.h>
#include <undine/scene/scene.h>

#include <functional>

namespace undine
{
  /// What watches a run.
  template <int dim>
  struct Watch
  {
    std::function<void(const State<dim> &, const Report &)> step;    ///< has led to the state
    std::function<void(const State<dim> &)>                 outputs; ///< have been written
  };


  /// What the probes measure of the new state joins what the models did.
  template <int dim>
  void
  ask_probes(Report &report, const State<dim> &state, const Scene<dim> &scene, TimingTree &timing);


  /// The whole of a simulation. `state` is at its first time, initial or resumed. Collective.
  /// Throws Interruption if the run is asked to stop, and what a step throws.
  template <int dim>
  void
  run_time_loop(
    State<dim> &state, Scene<dim> &scene, const Watch<dim> &watch, Log &log, TimingTree &timing);
} // namespace undine

#endif
