// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_linear_band_correction_h
#define undine_coupled_linear_band_correction_h

#include <undine/coupled/linear/block_triangular.h>
#include <undine/coupled/linear/joint_factorisation.h>

namespace undine
{
  /// The block-triangular preconditioner, then an exact solve for what it leaves of the residual at
  /// bodies and in a band of cells around them, where fluid and bodies act on each other.
  class BandCorrection : public BlockPreconditioner
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
    BlockTriangular            triangular;
    const BlockSystem         *system = nullptr;
    unsigned int               layers = 2;
    mutable JointFactorisation band;
  };
} // namespace undine

#endif
