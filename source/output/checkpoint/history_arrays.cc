// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/checkpoint/history_arrays.h>

#include <deal.II/base/mpi.h>

namespace undine
{
  namespace
  {
    /// Call `action(number)` for all numbers of a history.
    template <class History, class Action>
    void
    for_each_number(History &history, const Action &action)
    {
      for (auto *number : {&history.largest,
                           &history.derivative,
                           &history.error,
                           &history.best_step,
                           &history.next_step,
                           &history.step})
        action(*number);
      for_each_sample(history, [&](const std::string &, auto &sample) { action(sample.time); });
    }
  } // namespace


  template <int dim>
  StateArray
  pack_numbers(const StepHistory<dim> &history, const MPI_Comm communicator)
  {
    std::vector<double> numbers{double(history.n_samples)};
    for_each_number(history, [&](const double number) { numbers.push_back(number); });
    return numbers_of_first_rank("history/numbers", numbers, communicator);
  }


  template <int dim>
  void
  unpack_numbers(StepHistory<dim> &history, const StateArray &array, const MPI_Comm communicator)
  {
    const auto values = dealii::Utilities::MPI::broadcast(communicator, array.values);
    auto       value  = values.begin();
    history.n_samples = *value++;
    for_each_number(history, [&](double &number) { number = *value++; });
  }


#define UNDINE_INSTANTIATE(dim)                                               \
  template StateArray pack_numbers(const StepHistory<dim> &, const MPI_Comm); \
  template void       unpack_numbers(StepHistory<dim> &, const StateArray &, const MPI_Comm);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
