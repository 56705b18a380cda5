// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/disjoint_sets.h>
#include <undine/fluid/grid/fluid_regions.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace undine
{
  namespace
  {
    using Number = dealii::types::global_dof_index;


    /// For each set of this rank, known by its smallest number, the smallest one of the whole set
    /// that `joined` pairs of numbers on different ranks make of them. Collective.
    std::map<Number, Number>
    join_over_ranks(const std::set<Number>                    &sets,
                    const std::set<std::pair<Number, Number>> &joined,
                    const MPI_Comm                             communicator)
    {
      const auto all_sets = dealii::Utilities::MPI::all_gather(
        communicator, std::vector<Number>(sets.begin(), sets.end()));
      const auto all_pairs = dealii::Utilities::MPI::all_gather(
        communicator, std::vector<std::pair<Number, Number>>(joined.begin(), joined.end()));
      std::set<Number> known;
      for (const auto &of_rank : all_sets)
        known.insert(of_rank.begin(), of_rank.end());
      const std::vector<Number> labels(known.begin(), known.end());
      const auto                position = [&](const Number label) {
        return std::lower_bound(labels.begin(), labels.end(), label) - labels.begin();
      };
      DisjointSets whole(labels.size());
      for (const auto &of_rank : all_pairs)
        for (const auto &pair : of_rank)
          whole.join(position(pair.first), position(pair.second));
      std::map<Number, Number> result;
      for (const Number label : labels)
        result[label] = labels[whole.smallest(position(label))];
      return result;
    }
  } // namespace


  template <int dim>
  FluidRegions<dim>::FluidRegions(const MacGrid<dim> &grid, const PressureNumbers<dim> &numbers)
  {
    const auto  &owned = numbers.owned();
    const Number begin = owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0;
    DisjointSets mine(owned.n_elements());
    const auto   is_mine = [&](const Number number) {
      return number >= begin && number - begin < owned.n_elements();
    };
    const auto *open = numbers.topology().get();
    for_each_connection(grid, open, [&](const auto &below, const auto &above) {
      const Number first = numbers.of(below), second = numbers.of(above);
      if (is_mine(first) && is_mine(second))
        mine.join(first - begin, second - begin);
    });

    // The label of a pressure: the lowest number of its set on its rank. Neighbours need to know.
    std::set<Number> sets;
    Field<dim>       labels(grid.cells(), numbers.topology());
    Number           next = 0;
    for_each_value(labels, [&](double &label, const auto &, const auto &) {
      const Number smallest = begin + mine.smallest(next++);
      label                 = smallest;
      sets.insert(smallest);
    });
    labels.exchange(1);
    std::set<std::pair<Number, Number>> joined;
    for_each_connection(grid, open, [&](const auto &below, const auto &above) {
      if (is_mine(numbers.of(below)) != is_mine(numbers.of(above)))
        joined.emplace(value_at(labels, below), value_at(labels, above));
    });

    const auto whole = join_over_ranks(sets, joined, grid.communicator());
    for (const auto &entry : whole)
      if (entry.first == entry.second)
        first_numbers.push_back(entry.first);
    for (Number k = 0; k < owned.n_elements(); ++k)
      {
        const Number first = whole.at(begin + mine.smallest(k));
        regions.push_back(std::lower_bound(first_numbers.begin(), first_numbers.end(), first) -
                          first_numbers.begin());
      }
  }


  template class FluidRegions<2>;
  template class FluidRegions<3>;
} // namespace undine
