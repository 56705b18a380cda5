// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_checkpoint_impulses_array_h
#define undine_output_checkpoint_impulses_array_h

#include <undine/coupled/state/impulses.h>
#include <undine/output/checkpoint/state_arrays.h>

namespace undine
{
  /// The array that holds State::impulses in a checkpoint.
  inline const std::string impulses_array = "impulses";

  /// All numbers, of the first rank, and the reverse for as many bodies and obstacles. Collective.
  /// @{
  template <int dim>
  StateArray
  pack_impulses(const Impulses<dim> &impulses, MPI_Comm communicator);

  template <int dim>
  void
  unpack_impulses(Impulses<dim> &impulses, const StateArray &array, MPI_Comm communicator);
  /// @}
} // namespace undine

#endif
