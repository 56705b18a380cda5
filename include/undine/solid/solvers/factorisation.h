// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_solvers_factorisation_h
#define undine_solid_solvers_factorisation_h

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Amesos_BaseSolver.h>
#include <Epetra_LinearProblem.h>

#include <memory>

namespace undine
{
  /// Sparse factors of one matrix after the other (MUMPS or KLU through Amesos); the analysis is
  /// done once for all that follow with the same sparsity pattern. All functions are collective and
  /// throw SolveError on all ranks if the matrix is singular or has entries that are no numbers.
  class Factorisation
  {
  public:
    /// Factorise a copy of A.
    void
    factorise(const dealii::TrilinosWrappers::SparseMatrix &A);

    /// A^{-1} b for the A factorised last.
    dealii::TrilinosWrappers::MPI::Vector
    solve(const dealii::TrilinosWrappers::MPI::Vector &b);

  private:
    void
    analyse(const dealii::TrilinosWrappers::SparseMatrix &A);

    dealii::TrilinosWrappers::SparseMatrix matrix; ///< a copy, to which the factors stay bound
    Epetra_LinearProblem                   problem;
    std::unique_ptr<Amesos_BaseSolver>     solver;
  };
} // namespace undine

#endif
