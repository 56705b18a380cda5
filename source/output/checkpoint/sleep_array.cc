// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/checkpoint/sleep_array.h>

#include <deal.II/base/mpi.h>

namespace undine
{
  template <int dim>
  StateArray
  pack_sleep(const SleepState<dim> &sleep, const MPI_Comm communicator)
  {
    std::vector<double> numbers{(sleep.settled ? 1. : 0.) + (sleep.begins_anew ? 2. : 0.)};
    for (const bool asleep : sleep.asleep)
      numbers.push_back(asleep ? 1 : 0);
    numbers.insert(numbers.end(), sleep.slow_time.begin(), sleep.slow_time.end());
    numbers.insert(numbers.end(), sleep.unbalanced.begin(), sleep.unbalanced.end());
    for (const auto &load : sleep.loads)
      numbers.insert(numbers.end(), load.begin_raw(), load.end_raw());
    return numbers_of_first_rank("sleep", numbers, communicator);
  }


  template <int dim>
  void
  unpack_sleep(SleepState<dim> &sleep, const StateArray &array, const MPI_Comm communicator)
  {
    const auto values = dealii::Utilities::MPI::broadcast(communicator, array.values);
    auto       value  = values.begin();
    const int  flags  = static_cast<int>(*value++);
    sleep.settled     = flags % 2 != 0;
    sleep.begins_anew = flags >= 2;
    for (std::size_t body = 0; body < sleep.asleep.size(); ++body)
      sleep.asleep[body] = *value++ != 0;
    for (double &slow_time : sleep.slow_time)
      slow_time = *value++;
    for (double &unbalanced : sleep.unbalanced)
      unbalanced = *value++;
    for (auto &load : sleep.loads)
      for (unsigned int axis = 0; axis < dim; ++axis)
        load[axis] = *value++;
  }


#define UNDINE_INSTANTIATE(dim)                                      \
  template StateArray pack_sleep(const SleepState<dim> &, MPI_Comm); \
  template void       unpack_sleep(SleepState<dim> &, const StateArray &, MPI_Comm);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
