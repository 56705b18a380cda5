// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_multigrid_multigrid_level_h
#define undine_base_multigrid_multigrid_level_h

#include <undine/base/multigrid/cell_equations.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace undine
{
  /// The matrix A of CellEquations in single precision, and what a cycle of multigrid does with it.
  /// Unknowns are relaxed one after another, those of other ranks as they were before: forward
  /// before the correction by the coarser level and backward after it, so that the cycle is
  /// symmetric.
  class MultigridLevel
  {
  public:
    using Vector = dealii::LinearAlgebra::distributed::Vector<float>;

    explicit MultigridLevel(const CellEquations &equations);

    Vector
    vector() const;

    /// x := (D + L_A)^-1 b with the lower triangle L_A of A, the result of relaxation from zero.
    void
    relax_from_zero(Vector &x, const Vector &b) const;

    /// coarse_b := P^T (b - A x) for the x of relax_from_zero(); P takes the value of each
    /// aggregate to its members. Collective.
    void
    restrict_residual(Vector &coarse_b, Vector &x, const std::vector<int> &aggregates) const;

    /// x += P coarse_x.
    void
    prolongate(Vector &x, const Vector &coarse_x, const std::vector<int> &aggregates) const;

    /// x := x + (D + U_A)^-1 (b - A x) with the upper triangle U_A of A. Collective.
    void
    relax_backward(Vector &x, const Vector &b) const;

    std::size_t
    memory_consumption() const;

  private:
    /// Beginnings of rows in `columns` and `values`: first those of owned unknowns before this one,
    /// then all others.
    struct Row
    {
      unsigned int begin;
      unsigned int after;
    };

    std::shared_ptr<const CellEquations::Partitioner> partitioner;
    std::vector<Row>                                  rows; ///< one more than unknowns
    std::vector<unsigned int>                         columns;
    std::vector<float>                                values;
    std::vector<float>                                inverse_diagonal;
  };
} // namespace undine

#endif
