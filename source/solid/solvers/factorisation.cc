// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/parallel/throw_together.h>
#include <undine/solid/assembly/sparse.h>
#include <undine/solid/solvers/factorisation.h>

#include <Amesos.h>
#include <Teuchos_ParameterList.hpp>

#include <cmath>

namespace undine
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  namespace
  {
    const char *const failure = "the matrix of the bodies is singular or not a number. Try: clamps "
                                "that leave no rigid motion (static), or a smaller step.";


    /// Does the action, which returns 0 for success, fail on any rank?
    template <class Action>
    bool
    fails(const Action &action, const MPI_Comm communicator)
    {
      bool failed = false;
      try
        {
          failed = action() != 0;
        }
      catch (const std::exception &)
        {
          failed = true;
        }
      return dealii::Utilities::MPI::logical_or(failed, communicator);
    }


    /// KLU has the smaller overhead, MUMPS works on blocks.
    std::string
    solver_name(const Matrix &A)
    {
      const unsigned int few = 100000;
      return A.n_nonzero_elements() > few && Amesos().Query("Amesos_Mumps") ? "Amesos_Mumps"
                                                                            : "Amesos_Klu";
    }
  } // namespace


  void
  Factorisation::analyse(const Matrix &A)
  {
    solver.reset(); // before the matrix to which it is bound
    matrix.reinit(A);
    problem.SetOperator(const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix()));
    solver.reset(Amesos().Create(solver_name(A), problem));
    Teuchos::ParameterList parameters;
    parameters.set("OutputLevel", 0);
    // Percent of working space beyond the estimate: pivots may be delayed.
    parameters.sublist("mumps").set("ICNTL(14)", 60);
    solver->SetParameters(parameters);
  }


  void
  Factorisation::factorise(const Matrix &A)
  {
    const bool is_new = solver == nullptr || !same_pattern(matrix, A);
    if (is_new)
      analyse(A);
    matrix = 0;
    matrix.add(1., A);
    const auto act = [&] {
      if (!std::isfinite(matrix.frobenius_norm()))
        return -1;
      const int error = is_new ? solver->SymbolicFactorization() : 0;
      return error != 0 ? error : solver->NumericFactorization();
    };
    if (fails(act, A.get_mpi_communicator()))
      {
        solver.reset();
        throw SolveError(failure);
      }
  }


  Vector
  Factorisation::solve(const Vector &b)
  {
    Vector     x(b.locally_owned_elements(), b.get_mpi_communicator());
    const auto act = [&] {
      problem.SetLHS(&x.trilinos_vector());
      problem.SetRHS(const_cast<Epetra_MultiVector *>(&b.trilinos_vector()));
      return solver->Solve();
    };
    const bool has_failed = fails(act, b.get_mpi_communicator());
    // The next analysis would ask vectors that are gone how many there are.
    problem.SetLHS(nullptr);
    problem.SetRHS(nullptr);
    if (has_failed || !std::isfinite(x.l2_norm()))
      throw SolveError(failure);
    return x;
  }
} // namespace undine
