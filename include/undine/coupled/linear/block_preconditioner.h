// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_linear_block_preconditioner_h
#define undine_coupled_linear_block_preconditioner_h

#include <undine/base/options/options.h>
#include <undine/coupled/linear/schur_complement.h>

#include <functional>
#include <memory>

namespace undine
{
  /// A preconditioner of a BlockSystem. Each is one .cc file that registers itself.
  class BlockPreconditioner
  {
  public:
    using Vector      = BlockSystem::Vector;
    using BlockVector = BlockSystem::BlockVector;
    using Matrix      = BlockSystem::Matrix;

    /// apply(x, b): x = about A^{-1} b.
    using ApplyInverse = std::function<void(Vector &, const Vector &)>;

    virtual ~BlockPreconditioner() = default;

    /// Declare and read the keys of this preconditioner.
    virtual void
    add_options(const Options &options) = 0;

    /// A new stage of a step, in which bodies and pressures are elsewhere.
    virtual void
    start_step()
    {
    }

    /// All that is given must outlive the calls of vmult(). Collective.
    virtual void
    initialize(const BlockSystem     &system,
               const SchurComplement &schur,
               const ApplyInverse    &tangent_inverse) = 0;

    /// A solution begins for another right side of the same system.
    virtual void
    start_solve()
    {
    }

    /// result = about the inverse of the system times `right_side`; not always the same linear map.
    /// Collective. Throws SolveError.
    virtual void
    vmult(BlockVector &result, const BlockVector &right_side) const = 0;
  };
} // namespace undine

#endif
