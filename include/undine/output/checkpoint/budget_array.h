// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_checkpoint_budget_array_h
#define undine_output_checkpoint_budget_array_h

#include <undine/coupled/state/budget_amounts.h>
#include <undine/output/checkpoint/state_arrays.h>

namespace undine
{
  /// The array that holds State::budget_rates in a checkpoint.
  inline const std::string budget_array = "budget rates";

  /// All numbers, of the first rank, and the reverse for as many effects. Collective. @{
  template <int dim>
  StateArray
  pack_budget(const BudgetAmounts<dim> &rates, MPI_Comm communicator);

  template <int dim>
  void
  unpack_budget(BudgetAmounts<dim> &rates, const StateArray &array, MPI_Comm communicator);
  /// @}
} // namespace undine

#endif
