// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_linear_block_triangular_h
#define undine_coupled_linear_block_triangular_h

#include <undine/coupled/linear/block_preconditioner.h>

namespace undine
{
  /// [A -B^T; 0 S]^{-1} with one multigrid cycle for S^{-1}: pressures first, bodies under
  /// these.
  class BlockTriangular : public BlockPreconditioner
  {
  public:
    void
    add_options(const Options &options) override;

    void
    initialize(const BlockSystem     &system,
               const SchurComplement &schur,
               const ApplyInverse    &tangent_inverse) override;

    void
    vmult(BlockVector &result, const BlockVector &right_side) const override;

  private:
    const BlockSystem     *system = nullptr;
    const SchurComplement *schur  = nullptr;
    ApplyInverse           tangent_inverse;
  };
} // namespace undine

#endif
