// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_checkpoint_history_arrays_h
#define undine_output_checkpoint_history_arrays_h

#include <undine/coupled/state/step_history.h>
#include <undine/output/checkpoint/state_arrays.h>

#include <string>

namespace undine
{
  /// Call `action(name, sample)` for the samples of a StepHistory.
  template <class History, class Action>
  void
  for_each_sample(History &history, const Action &action)
  {
    for (std::size_t i = 0; i < history.samples.size(); ++i)
      action("history/" + std::to_string(i), history.samples[i]);
    if (history.in_use())
      action("history/before", history.before);
  }


  /// Call `action(name, field)` for all fields of these samples.
  template <int dim, class History, class Action>
  void
  for_each_field_of_samples(History &history, const Action &action)
  {
    const auto all_axes = [&](const std::string &name, auto &velocity) {
      for (unsigned int axis = 0; axis < dim; ++axis)
        action(name + '_' + char('x' + axis), velocity[axis]);
    };
    for_each_sample(history, [&](const std::string &name, auto &sample) {
      all_axes(name + "/fluid", sample.fluid);
    });
    if (history.in_use())
      all_axes("history/uncut", history.uncut);
  }


  /// The numbers of a history that is in use; the first rank's go to the file.
  template <int dim>
  StateArray
  pack_numbers(const StepHistory<dim> &history, MPI_Comm communicator);

  /// Set the numbers of a history from that array. Collective.
  template <int dim>
  void
  unpack_numbers(StepHistory<dim> &history, const StateArray &array, MPI_Comm communicator);
} // namespace undine

#endif
