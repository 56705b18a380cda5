// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_checkpoint_sleep_array_h
#define undine_output_checkpoint_sleep_array_h

#include <undine/coupled/state/sleep_state.h>
#include <undine/output/checkpoint/state_arrays.h>

namespace undine
{
  /// "sleep": all numbers of a state in use, of the first rank, and the reverse for a state of the
  /// same sizes. Collective. @{
  template <int dim>
  StateArray
  pack_sleep(const SleepState<dim> &sleep, MPI_Comm communicator);

  template <int dim>
  void
  unpack_sleep(SleepState<dim> &sleep, const StateArray &array, MPI_Comm communicator);
  /// @}
} // namespace undine

#endif
