// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/core/registry.h>
#include <undine/coupled/linear/band_correction.h>

namespace undine
{
  /// The block-triangular preconditioner as long as a solve does not take too many iterations with
  /// it; then the band correction, from that iteration to the end of the stage. That is allowed to
  /// change within a solve, as GMRES is flexible, which keeps what it has found so far.
  ///
  /// Soft thin bodies in a heavier fluid need it: S has the compliance of nodes, diag |A|^-1, and
  /// not that of bending, of which the band has both sides.
  class AutomaticPreconditioner : public BlockPreconditioner
  {
  public:
    void
    add_options(const Options &options) override
    {
      triangular.add_options(options);
      corrected.add_options(options);
      options.add("Iterations without band",
                  most_calls,
                  "",
                  Allowed::positive(),
                  "Of a solve, after which the equations around the bodies are solved exactly.");
    }

    void
    start_step() override
    {
      is_corrected = false;
    }

    void
    initialize(const BlockSystem     &new_system,
               const SchurComplement &new_schur,
               const ApplyInverse    &new_tangent_inverse) override
    {
      system          = &new_system;
      schur           = &new_schur;
      tangent_inverse = new_tangent_inverse;
      if (is_corrected)
        corrected.initialize(*system, *schur, tangent_inverse);
      else
        triangular.initialize(*system, *schur, tangent_inverse);
    }

    void
    start_solve() override
    {
      n_calls = 0;
    }

    void
    vmult(BlockVector &result, const BlockVector &right_side) const override
    {
      if (!is_corrected && n_calls++ == most_calls)
        try
          {
            corrected.initialize(*system, *schur, tangent_inverse);
            is_corrected = true;
          }
        catch (const SolveError &)
          {
            // Without factors of the band, for want of memory say, the solve goes on as it was.
          }
      if (is_corrected)
        corrected.vmult(result, right_side);
      else
        triangular.vmult(result, right_side);
    }

  private:
    BlockTriangular        triangular;
    mutable BandCorrection corrected;
    mutable bool           is_corrected = false;
    unsigned int           most_calls   = 40;
    mutable unsigned int   n_calls      = 0; ///< of vmult() in this solve
    const BlockSystem     *system       = nullptr;
    const SchurComplement *schur        = nullptr;
    ApplyInverse           tangent_inverse;
  };


  static const Register<BlockPreconditioner, AutomaticPreconditioner>
    automatic("automatic",
              "Block triangular; where a solve takes many iterations, with band correction.");
} // namespace undine
