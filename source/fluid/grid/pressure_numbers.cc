// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/pressure_numbers.h>

#include <deal.II/base/mpi.h>

#include <utility>

namespace undine
{
  template <int dim>
  PressureNumbers<dim>::PressureNumbers(const MacGrid<dim>                       &grid,
                                        std::shared_ptr<const FluidTopology<dim>> topology)
    : lattice(grid.cells())
    , open(std::move(topology))
  {
    if (!open)
      {
        mine = lattice->owned_numbers();
        return;
      }
    numbers      = Field<dim>(lattice, open);
    Number count = 0;
    for_each_value(numbers, [&](double &, const auto &, const auto &) { ++count; });
    mine = dealii::Utilities::MPI::create_ascending_partitioning(
      grid.communicator(), count)[dealii::Utilities::MPI::this_mpi_process(grid.communicator())];
    Number next = count > 0 ? mine.nth_index_in_set(0) : 0;
    for_each_value(numbers, [&](double &number, const auto &, const auto &) { number = next++; });
    numbers.exchange(1);
  }


  template class PressureNumbers<2>;
  template class PressureNumbers<3>;
} // namespace undine
