// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/parallel/matrix_row.h>
#include <undine/coupled/linear/joint_factorisation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    using Vector = BlockSystem::Vector;
    using Matrix = BlockSystem::Matrix;
    using Index  = dealii::types::global_dof_index;


    /// What a matrix names as its columns in the rows of this rank, with these rows.
    dealii::IndexSet
    known_columns(const Matrix &matrix)
    {
      auto               result = matrix.locally_owned_range_indices();
      const auto        &map    = matrix.trilinos_matrix().ColMap();
      std::vector<Index> columns(map.MyGlobalElements(),
                                 map.MyGlobalElements() + map.NumMyElements());
      std::sort(columns.begin(), columns.end());
      result.add_indices(columns.begin(), std::unique(columns.begin(), columns.end()));
      return result;
    }


    /// For each pressure known to this rank its row in the joint matrix; not_chosen if it has none.
    class JointNumbers
    {
    public:
      static constexpr double not_chosen = -1;

      JointNumbers(const BlockSystem      &system,
                   const dealii::IndexSet &chosen,
                   const Index             first,
                   const MPI_Comm          communicator)
      {
        const auto owned = system.pressure().locally_owned_range_indices();
        Vector     mine(owned, communicator);
        for (auto &value : mine)
          value = not_chosen;
        Index next = first;
        for (const auto pressure : chosen)
          mine(pressure) = next++;
        mine.compress(dealii::VectorOperation::insert);
        numbers.reinit(owned, known_columns(system.pressure()), communicator);
        numbers = mine;
      }

      bool
      contains(const Index pressure) const
      {
        return numbers(pressure) != not_chosen;
      }

      Index
      operator()(const Index pressure) const
      {
        return static_cast<Index>(numbers(pressure));
      }

    private:
      Vector numbers; ///< exact as numbers up to 2^53
    };


    struct Entry
    {
      Index  row, column;
      double value;
    };


    /// Of the joint matrix, as far as this rank knows them, by rows.
    std::vector<Entry>
    joint_entries(const BlockSystem      &system,
                  const dealii::IndexSet &chosen,
                  const JointNumbers     &numbers)
    {
      std::vector<Entry> result;
      for (const auto row : system.tangent().locally_owned_range_indices())
        for_each_in_row(system.tangent(), row, [&](const Index column, const double value) {
          result.push_back({row, column, value});
        });
      for (const auto pressure : chosen)
        {
          const Index row = numbers(pressure);
          for_each_in_row(system.flux(), pressure, [&](const Index column, const double value) {
            result.push_back({row, column, system.flux_factor() * value});
            result.push_back({column, row, -value});
          });
          for_each_in_row(system.pressure(), pressure, [&](const Index column, const double value) {
            if (numbers.contains(column))
              result.push_back({row, numbers(column), value});
          });
        }
      std::stable_sort(
        result.begin(), result.end(), [](const Entry &a, const Entry &b) { return a.row < b.row; });
      return result;
    }


    /// Call action(row, columns, values) for each row of these entries.
    template <class Action>
    void
    for_each_row(const std::vector<Entry> &entries, const Action &action)
    {
      std::vector<Index>  columns;
      std::vector<double> values;
      for (auto entry = entries.begin(); entry != entries.end();)
        {
          const Index row = entry->row;
          columns.clear();
          values.clear();
          for (; entry != entries.end() && entry->row == row; ++entry)
            {
              columns.push_back(entry->column);
              values.push_back(entry->value);
            }
          action(row, columns, values);
        }
    }


    struct JointRows
    {
      dealii::IndexSet all;            ///< of this rank
      Index            first_pressure; ///< what its first pressure has
    };


    /// Velocities of this rank, then its pressures behind those of lower ranks.
    JointRows
    joint_rows(const BlockSystem      &system,
               const dealii::IndexSet &chosen,
               const MPI_Comm          communicator)
    {
      const Index n_velocities = system.tangent().m();
      const Index mine         = chosen.n_elements();
      const auto  counts       = dealii::Utilities::MPI::all_gather(communicator, mine);
      const auto  rank         = dealii::Utilities::MPI::this_mpi_process(communicator);
      Index       before = 0, all = 0;
      for (unsigned int r = 0; r < counts.size(); ++r)
        {
          before += r < rank ? counts[r] : 0;
          all += counts[r];
        }
      dealii::IndexSet rows(n_velocities + all);
      rows.add_indices(system.tangent().locally_owned_range_indices());
      rows.add_range(n_velocities + before, n_velocities + before + mine);
      rows.compress();
      return {rows, n_velocities + before};
    }


    Matrix
    joint_matrix(const BlockSystem      &system,
                 const dealii::IndexSet &chosen,
                 const JointRows        &rows,
                 const MPI_Comm          communicator)
    {
      const JointNumbers numbers(system, chosen, rows.first_pressure, communicator);
      const auto         entries  = joint_entries(system, chosen, numbers);
      dealii::IndexSet   writable = rows.all;
      for_each_row(entries,
                   [&](const Index row, const auto &, const auto &) { writable.add_index(row); });
      writable.compress();
      dealii::TrilinosWrappers::SparsityPattern pattern(rows.all, rows.all, writable, communicator);
      for_each_row(entries, [&](const Index row, const auto &columns, const auto &) {
        pattern.add_entries(row, columns.begin(), columns.end());
      });
      pattern.compress();
      Matrix matrix;
      matrix.reinit(pattern);
      for_each_row(entries, [&](const Index row, const auto &columns, const auto &values) {
        matrix.add(row, columns, values);
      });
      matrix.compress(dealii::VectorOperation::add);
      return matrix;
    }
  } // namespace


  void
  JointFactorisation::factorise(const BlockSystem &system, const dealii::IndexSet &pressures)
  {
    chosen              = pressures;
    communicator        = system.pressure().get_mpi_communicator();
    const auto all_rows = joint_rows(system, chosen, communicator);
    rows                = all_rows.all;
    factorisation.factorise(joint_matrix(system, chosen, all_rows, communicator));
  }


  JointFactorisation::BlockVector
  JointFactorisation::solve(const BlockVector &right_side)
  {
    const auto &velocities = right_side.block(0).locally_owned_elements();
    Vector      joint(rows, communicator);
    Index       next = velocities.n_elements();
    // Entries of a vector lie in the order of its rows.
    std::copy(right_side.block(0).begin(), right_side.block(0).end(), joint.begin());
    for (const auto pressure : chosen)
      joint.begin()[next++] = right_side.block(1)(pressure);
    joint = factorisation.solve(joint);

    BlockVector result;
    result.reinit(right_side);
    std::copy(joint.begin(), joint.begin() + velocities.n_elements(), result.block(0).begin());
    next = velocities.n_elements();
    for (const auto pressure : chosen)
      result.block(1)(pressure) = joint.begin()[next++];
    result.compress(dealii::VectorOperation::insert);
    return result;
  }
} // namespace undine
