// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/coupled/linear/block_triangular.h>

namespace undine
{
  void
  BlockTriangular::add_options(const Options &)
  {
  }


  void
  BlockTriangular::initialize(const BlockSystem     &new_system,
                              const SchurComplement &new_schur,
                              const ApplyInverse    &new_tangent_inverse)
  {
    system          = &new_system;
    schur           = &new_schur;
    tangent_inverse = new_tangent_inverse;
  }


  void
  BlockTriangular::vmult(BlockVector &result, const BlockVector &right_side) const
  {
    schur->apply_inverse(result.block(1), right_side.block(1));
    Vector forces(right_side.block(0));
    system->flux().Tvmult(forces, result.block(1));
    forces.add(1., right_side.block(0));
    tangent_inverse(result.block(0), forces);
  }


  static const Register<BlockPreconditioner, BlockTriangular>
    block_triangular("block triangular",
                     "Pressures by multigrid for h L + B diag(A)^-1 B^T, then the bodies.");
} // namespace undine
