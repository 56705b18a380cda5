// SPDX-License-Identifier: LGPL-2.1-or-later
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
      std::vector<Index> columns;
      for (const auto row : matrix.locally_owned_range_indices())
        for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry)
          columns.push_back(entry->column());
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


    /// Call action(row, column, value) for the entries of the joint matrix that this rank knows.
    template <class Action>
    void
    for_each_entry(const BlockSystem      &system,
                   const dealii::IndexSet &chosen,
                   const JointNumbers     &numbers,
                   const Action           &action)
    {
      const auto &A = system.tangent(), &B = system.flux(), &hL = system.pressure();
      for (const auto row : A.locally_owned_range_indices())
        for (auto entry = A.begin(row); entry != A.end(row); ++entry)
          action(row, entry->column(), entry->value());
      for (const auto pressure : chosen)
        {
          const Index row = numbers(pressure);
          for (auto entry = B.begin(pressure); entry != B.end(pressure); ++entry)
            {
              action(row, entry->column(), system.flux_factor() * entry->value());
              action(entry->column(), row, -entry->value());
            }
          for (auto entry = hL.begin(pressure); entry != hL.end(pressure); ++entry)
            if (numbers.contains(entry->column()))
              action(row, numbers(entry->column()), entry->value());
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
      dealii::IndexSet   writable = rows.all;
      for_each_entry(system, chosen, numbers, [&](const Index row, const Index, const double) {
        writable.add_index(row);
      });
      writable.compress();
      dealii::TrilinosWrappers::SparsityPattern pattern(rows.all, rows.all, writable, communicator);
      for_each_entry(
        system, chosen, numbers, [&](const Index row, const Index column, const double) {
          pattern.add(row, column);
        });
      pattern.compress();
      Matrix matrix;
      matrix.reinit(pattern);
      for_each_entry(
        system, chosen, numbers, [&](const Index row, const Index column, const double value) {
          matrix.add(row, column, value);
        });
      matrix.compress(dealii::VectorOperation::add);
      return matrix;
    }
  } // namespace


  JointFactorisation::JointFactorisation(const BlockSystem      &system,
                                         const dealii::IndexSet &pressures)
    : chosen(pressures)
    , communicator(system.pressure().get_mpi_communicator())
  {
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
