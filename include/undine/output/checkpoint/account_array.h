// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_checkpoint_account_array_h
#define undine_output_checkpoint_account_array_h

#include <undine/coupled/state/energy_account.h>
#include <undine/output/checkpoint/state_arrays.h>

namespace undine
{
  /// The array that holds State::account in a checkpoint.
  inline const std::string account_array = "energy account";

  /// All numbers, of the first rank, and the reverse. Collective. @{
  StateArray
  pack_account(const EnergyAccount &account, MPI_Comm communicator);
  EnergyAccount
  unpack_account(const StateArray &array, MPI_Comm communicator);
  /// @}
} // namespace undine

#endif
