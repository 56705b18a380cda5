// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_linear_joint_factorisation_h
#define undine_coupled_linear_joint_factorisation_h

#include <undine/coupled/linear/block_system.h>
#include <undine/solid/solvers/factorisation.h>

namespace undine
{
  /// Sparse factors of a BlockSystem restricted to all velocities of the bodies and some of the
  /// pressures: a direct solver if these are all of them.
  class JointFactorisation
  {
  public:
    using BlockVector = BlockSystem::BlockVector;

    /// `pressures`: the numbers of the chosen pressures of this rank. The system is not needed
    /// afterwards. What depends on the pattern of the matrix alone is kept for the next one.
    /// Collective. Throws SolveError if the matrix is singular or not a number.
    void
    factorise(const BlockSystem &system, const dealii::IndexSet &pressures);

    /// The solution of the restricted system for the entries of `right_side` that belong to it;
    /// other pressures are zero. Collective.
    BlockVector
    solve(const BlockVector &right_side);

  private:
    using Vector = BlockSystem::Vector;

    dealii::IndexSet chosen; ///< pressures of this rank
    dealii::IndexSet rows;   ///< of this rank: velocities, then chosen pressures, numbered anew
    MPI_Comm         communicator = MPI_COMM_NULL;
    Factorisation    factorisation;
  };
} // namespace undine

#endif
