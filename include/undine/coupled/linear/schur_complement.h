// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_linear_schur_complement_h
#define undine_coupled_linear_schur_complement_h

#include <undine/base/multigrid/cell_preconditioner.h>
#include <undine/coupled/linear/block_system.h>

#include <memory>
#include <string>

namespace undine
{
  /// S = h L + k B diag|A|^-1 B^T [m^dim / (s Pa)], which stands for the Schur complement of a
  /// BlockSystem, h L + k B A^-1 B^T, and a multigrid cycle for its inverse.
  class SchurComplement
  {
  public:
    using Matrix = BlockSystem::Matrix;
    using Vector = BlockSystem::Vector;

    /// `places`: of the pressures; `multigrid`: name of a CellPreconditioner. Collective.
    SchurComplement(const BlockSystem     &system,
                    const CellsOfUnknowns &places,
                    const std::string     &multigrid);

    const Matrix &
    matrix() const
    {
      return S;
    }

    /// x := about S^-1 b. Collective.
    void
    apply_inverse(Vector &x, const Vector &b) const
    {
      inverse->vmult(x, b);
    }

    /// On this rank [bytes].
    std::size_t
    memory_consumption() const;

  private:
    Matrix                              S;
    std::unique_ptr<CellPreconditioner> inverse;
  };
} // namespace undine

#endif
