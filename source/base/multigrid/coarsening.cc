// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/disjoint_sets.h>
#include <undine/base/multigrid/coarsening.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <limits>

namespace undine
{
  namespace
  {
    using Box = CellEquations::Box;

    // Couplings weaker than this part of the strongest of an unknown do not join it to others.
    constexpr double weak = 0.2;

    constexpr unsigned int no_axis = 3;


    /// The direction in which one box is beside the other; no_axis: they overlap.
    unsigned int
    axis_between(const Box &a, const Box &b)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
        if (a.upper[axis] <= b.lower[axis] || b.upper[axis] <= a.lower[axis])
          return axis;
      return no_axis;
    }


    /// The distance of the middles of two fine neighbours over that of the coarse ones.
    double
    distance_ratio(
      const CellEquations &of, const Box &a, const Box &b, const Box &coarse_a, const Box &coarse_b)
    {
      const unsigned int axis = axis_between(coarse_a, coarse_b);
      if (axis == no_axis)
        return 1;
      return (of.width(a, axis) + of.width(b, axis)) /
             (of.width(coarse_a, axis) + of.width(coarse_b, axis));
    }


    /// The same for what is beyond the end of the domain, the smallest if there are several ends.
    double
    outward_distance_ratio(const CellEquations &of,
                           const Box           &fine,
                           const Box           &coarse,
                           const Box           &domain)
    {
      double result = 1;
      for (unsigned int axis = 0; axis < 3; ++axis)
        if (fine.lower[axis] == domain.lower[axis] || fine.upper[axis] == domain.upper[axis])
          result = std::min(result, of.width(fine, axis) / of.width(coarse, axis));
      return result;
    }


    /// The aggregates of owned unknowns; `n`: how many there are.
    std::vector<int>
    find_aggregates(const CellEquations      &fine,
                    const std::array<int, 3> &width,
                    const std::array<int, 3> &origin,
                    unsigned int             &n)
    {
      const unsigned int              n_owned = fine.n_owned();
      std::vector<std::array<int, 3>> blocks(n_owned);
      std::vector<double>             strongest(n_owned, 0.);
      for (unsigned int i = 0; i < n_owned; ++i)
        {
          for (unsigned int axis = 0; axis < 3; ++axis)
            blocks[i][axis] = (fine.boxes[i].lower[axis] - origin[axis]) / width[axis];
          for (std::size_t k = fine.row_begins[i]; k < fine.row_begins[i + 1]; ++k)
            strongest[i] = std::max(strongest[i], fine.entries[k].coupling);
        }
      DisjointSets sets(n_owned);
      for (unsigned int i = 0; i < n_owned; ++i)
        for (std::size_t k = fine.row_begins[i]; k < fine.row_begins[i + 1]; ++k)
          {
            const auto &entry = fine.entries[k];
            const auto  j     = entry.column;
            if (j < i && blocks[j] == blocks[i] && entry.coupling > 0 &&
                entry.coupling >= weak * std::min(strongest[i], strongest[j]))
              sets.join(i, j);
          }
      std::vector<int> result(n_owned, Coarsening::none);
      n = 0;
      for (unsigned int i = 0; i < n_owned; ++i)
        if (strongest[i] > 0)
          {
            const auto first = sets.smallest(i);
            result[i]        = first == i ? static_cast<int>(n++) : result[first];
          }
      return result;
    }


    /// The number of the aggregate of every unknown among those of all ranks, ghosts included.
    std::vector<double>
    global_numbers(const CellEquations    &fine,
                   const std::vector<int> &aggregates,
                   const dealii::IndexSet &coarse_owned)
    {
      const double first = coarse_owned.n_elements() > 0 ? coarse_owned.nth_index_in_set(0) : 0;
      dealii::LinearAlgebra::distributed::Vector<double> numbers(fine.partitioner);
      for (unsigned int i = 0; i < aggregates.size(); ++i)
        numbers.local_element(i) =
          aggregates[i] == Coarsening::none ? Coarsening::none : first + aggregates[i];
      numbers.update_ghost_values();
      std::vector<double> result(fine.boxes.size());
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] = numbers.local_element(i);
      return result;
    }


    std::shared_ptr<const CellEquations::Partitioner>
    coarse_partitioner(const CellEquations       &fine,
                       const dealii::IndexSet    &coarse_owned,
                       const std::vector<double> &numbers)
    {
      dealii::IndexSet ghosts(coarse_owned.size());
      for (unsigned int j = fine.n_owned(); j < numbers.size(); ++j)
        if (numbers[j] != Coarsening::none)
          ghosts.add_index(static_cast<dealii::types::global_dof_index>(numbers[j]));
      ghosts.compress();
      return std::make_shared<const CellEquations::Partitioner>(
        coarse_owned, ghosts, fine.partitioner->get_mpi_communicator());
    }


    /// The boxes around the members of each aggregate.
    void
    find_boxes(CellEquations &coarse, const CellEquations &fine, const std::vector<int> &aggregates)
    {
      constexpr int far = std::numeric_limits<int>::max();
      coarse.boxes.assign(coarse.n_owned(), {{{far, far, far}}, {{-far, -far, -far}}});
      for (unsigned int i = 0; i < aggregates.size(); ++i)
        if (aggregates[i] != Coarsening::none)
          for (unsigned int axis = 0; axis < 3; ++axis)
            {
              auto &box       = coarse.boxes[aggregates[i]];
              box.lower[axis] = std::min(box.lower[axis], fine.boxes[i].lower[axis]);
              box.upper[axis] = std::max(box.upper[axis], fine.boxes[i].upper[axis]);
            }
      coarse.exchange_boxes();
    }


    /// The owned unknowns of each aggregate.
    std::vector<std::vector<unsigned int>>
    members_of(const std::vector<int> &aggregates, const unsigned int n)
    {
      std::vector<std::vector<unsigned int>> result(n);
      for (unsigned int i = 0; i < aggregates.size(); ++i)
        if (aggregates[i] != Coarsening::none)
          result[aggregates[i]].push_back(i);
      return result;
    }


    /// All but the boxes of `coarse`. `coarse_columns`: those of the fine columns, or none.
    void
    sum_rows(CellEquations          &coarse,
             const CellEquations    &fine,
             const std::vector<int> &aggregates,
             const std::vector<int> &coarse_columns,
             const Box              &domain)
    {
      constexpr std::size_t    unseen = -1;
      std::vector<std::size_t> places(coarse.boxes.size(), unseen); // of columns in `entries`
      coarse.row_begins.assign(1, 0);
      int row = 0;
      for (const auto &members : members_of(aggregates, coarse.n_owned()))
        {
          const Box &box     = coarse.boxes[row];
          double     outward = 0, rest = 0;
          for (const auto i : members)
            {
              outward += fine.outward[i] * outward_distance_ratio(fine, fine.boxes[i], box, domain);
              rest += fine.rest_diagonal[i];
              for (std::size_t k = fine.row_begins[i]; k < fine.row_begins[i + 1]; ++k)
                {
                  const auto &entry  = fine.entries[k];
                  const int   column = coarse_columns[entry.column];
                  if (column == row)
                    rest += entry.rest;
                  if (column == row || column == Coarsening::none)
                    continue;
                  if (places[column] == unseen)
                    {
                      places[column] = coarse.entries.size();
                      coarse.entries.push_back({static_cast<unsigned int>(column), 0., 0.});
                    }
                  auto &sum = coarse.entries[places[column]];
                  if (entry.coupling > 0)
                    sum.coupling +=
                      entry.coupling *
                      distance_ratio(
                        fine, fine.boxes[i], fine.boxes[entry.column], box, coarse.boxes[column]);
                  sum.rest += entry.rest;
                }
            }
          coarse.outward.push_back(outward);
          coarse.rest_diagonal.push_back(rest);
          for (std::size_t k = coarse.row_begins.back(); k < coarse.entries.size(); ++k)
            places[coarse.entries[k].column] = unseen;
          coarse.row_begins.push_back(coarse.entries.size());
          ++row;
        }
    }
  } // namespace


  Coarsening
  coarsen(const CellEquations      &fine,
          const std::array<int, 3> &width,
          const std::array<int, 3> &origin,
          const Box                &domain)
  {
    Coarsening   result;
    unsigned int n          = 0;
    result.aggregates       = find_aggregates(fine, width, origin, n);
    const auto communicator = fine.partitioner->get_mpi_communicator();
    const auto owned        = dealii::Utilities::MPI::create_ascending_partitioning(
      communicator, n)[dealii::Utilities::MPI::this_mpi_process(communicator)];
    const auto numbers           = global_numbers(fine, result.aggregates, owned);
    result.equations.partitioner = coarse_partitioner(fine, owned, numbers);
    result.equations.planes      = fine.planes;
    find_boxes(result.equations, fine, result.aggregates);
    std::vector<int> columns(numbers.size(), Coarsening::none);
    for (unsigned int j = 0; j < columns.size(); ++j)
      if (numbers[j] != Coarsening::none)
        columns[j] = result.equations.partitioner->global_to_local(
          static_cast<dealii::types::global_dof_index>(numbers[j]));
    sum_rows(result.equations, fine, result.aggregates, columns, domain);
    return result;
  }
} // namespace undine
