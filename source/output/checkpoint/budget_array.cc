// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/checkpoint/budget_array.h>

#include <deal.II/base/mpi.h>

namespace undine
{
  template <int dim>
  StateArray
  pack_budget(const BudgetAmounts<dim> &rates, const MPI_Comm communicator)
  {
    std::vector<double> numbers = rates.by_effect;
    for (const auto &term : rates.terms)
      {
        numbers.push_back(term.energy);
        numbers.insert(numbers.end(), term.momentum.begin_raw(), term.momentum.end_raw());
      }
    return numbers_of_first_rank(budget_array, numbers, communicator);
  }


  template <int dim>
  void
  unpack_budget(BudgetAmounts<dim> &rates, const StateArray &array, const MPI_Comm communicator)
  {
    const auto values = dealii::Utilities::MPI::broadcast(communicator, array.values);
    auto       value  = values.begin();
    for (double &of_effect : rates.by_effect)
      of_effect = *value++;
    for (auto &term : rates.terms)
      {
        term.energy = *value++;
        for (unsigned int axis = 0; axis < dim; ++axis)
          term.momentum[axis] = *value++;
      }
  }


#define UNDINE_INSTANTIATE(dim)                                          \
  template StateArray pack_budget(const BudgetAmounts<dim> &, MPI_Comm); \
  template void       unpack_budget(BudgetAmounts<dim> &, const StateArray &, MPI_Comm);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
