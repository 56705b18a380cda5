// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/checkpoint/impulses_array.h>

#include <deal.II/base/mpi.h>

namespace undine
{
  /// Of each kind of force the sums, then the rates at the begin of the next step, or zeros; first
  /// whether these are known.
  template <int dim>
  StateArray
  pack_impulses(const Impulses<dim> &impulses, const MPI_Comm communicator)
  {
    std::vector<double> numbers{impulses.pressure.rates.empty() ? 0. : 1.};
    const auto          add = [&](const auto &vectors) {
      for (const auto &vector : vectors)
        numbers.insert(numbers.end(), vector.begin_raw(), vector.end_raw());
    };
    for (const auto *impulse : {&impulses.pressure, &impulses.friction})
      {
        const auto &rates = impulse->rates;
        add(impulse->sum);
        add(rates.empty() ? typename Impulse<dim>::Vectors(impulse->sum.size()) : rates.back());
      }
    return numbers_of_first_rank(impulses_array, numbers, communicator);
  }


  template <int dim>
  void
  unpack_impulses(Impulses<dim> &impulses, const StateArray &array, const MPI_Comm communicator)
  {
    const auto numbers   = dealii::Utilities::MPI::broadcast(communicator, array.values);
    auto       number    = numbers.begin();
    const bool are_known = *number++ != 0;
    const auto fill      = [&](auto &vectors) {
      for (auto &vector : vectors)
        for (unsigned int axis = 0; axis < dim; ++axis)
          vector[axis] = *number++;
    };
    for (auto *impulse : {&impulses.pressure, &impulses.friction})
      {
        typename Impulse<dim>::Vectors rates(impulse->sum.size());
        fill(impulse->sum);
        fill(rates);
        impulse->rates.clear();
        if (are_known)
          impulse->rates.push_back(rates);
      }
  }


#define UNDINE_INSTANTIATE(dim)                                       \
  template StateArray pack_impulses(const Impulses<dim> &, MPI_Comm); \
  template void       unpack_impulses(Impulses<dim> &, const StateArray &, MPI_Comm);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
