// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_multigrid_cell_preconditioner_h
#define undine_base_multigrid_cell_preconditioner_h

#include <undine/base/multigrid/cell_equations.h>

#include <deal.II/lac/trilinos_vector.h>

namespace undine
{
  /// A preconditioner for diffusion between cells of a grid, such as that of the pressure. Each is
  /// one .cc file that registers itself.
  class CellPreconditioner
  {
  public:
    using Matrix = CellEquations::Matrix;
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    virtual ~CellPreconditioner() = default;

    /// For `whole`, of which `diffusion`, perhaps the same object, is that part which couples
    /// neighbours. `whole` must outlive the calls of vmult(). Collective.
    virtual void
    initialize(const Matrix &diffusion, const Matrix &whole, const CellsOfUnknowns &places) = 0;

    /// x := about the inverse of `whole` times b, by a symmetric positive definite operator.
    /// Collective.
    virtual void
    vmult(Vector &x, const Vector &b) const = 0;

    /// On this rank [bytes].
    virtual std::size_t
    memory_consumption() const = 0;
  };
} // namespace undine

#endif
