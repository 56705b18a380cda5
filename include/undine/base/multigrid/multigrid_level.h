// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_multigrid_multigrid_level_h
#define undine_base_multigrid_multigrid_level_h

#include <undine/base/multigrid/cell_equations.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <memory>

namespace undine
{
  /// The matrix A of CellEquations in single precision, and what a cycle of multigrid does with it.
  /// Unknowns are relaxed one after another in some order, those of other ranks as they were
  /// before: forward before the correction by the coarser level and backward after it, so that the
  /// cycle is symmetric. L_A and U_A are what is before and after an unknown in that order.
  class MultigridLevel
  {
  public:
    using Vector = dealii::LinearAlgebra::distributed::Vector<float>;

    virtual ~MultigridLevel() = default;

    /// x := (D + L_A)^-1 b, the result of relaxation from zero.
    virtual void
    relax_from_zero(Vector &x, const Vector &b) const = 0;

    /// coarse_b := P^T (b - A x) for the x of relax_from_zero(); P takes the value of each
    /// aggregate to its members. Collective.
    virtual void
    restrict_residual(Vector &coarse_b, Vector &x, const std::vector<int> &aggregates) const = 0;

    /// x += P coarse_x.
    static void
    prolongate(Vector &x, const Vector &coarse_x, const std::vector<int> &aggregates);

    /// x := x + (D + U_A)^-1 (b - A x) with the b of relax_from_zero(). Collective.
    virtual void
    relax_backward(Vector &x, const Vector &b) const = 0;

    virtual std::size_t
    memory_consumption() const = 0;
  };


  /// Unknowns that fill a box of cells, or of blocks of cells, and are coupled to neighbours in it
  /// only are relaxed in the order of a chessboard, without lists of columns; all others in the
  /// order of their numbers.
  std::unique_ptr<const MultigridLevel>
  make_multigrid_level(const CellEquations &equations);

  /// The former; nullptr if this rank's unknowns are not like that.
  std::unique_ptr<const MultigridLevel>
  make_box_level(const CellEquations &equations);
} // namespace undine

#endif
