// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/solid/sparse.h>
#include <undine/solid/tangent_multigrid.h>
#include <undine/solid/tangent_preconditioner.h>

#include <deal.II/lac/solver_cg.h>

#include <cmath>

namespace undine
{
  namespace
  {
    // Of the inner iteration. Half a dozen steps pay for themselves by fewer outer ones.
    constexpr unsigned int most_iterations = 40;
    constexpr double       reduction       = 1e-2;
  } // namespace


  template <int dim>
  TangentPreconditioner<dim>::TangentPreconditioner(const SolidModel<dim> &model)
    : model(model)
    , direct(solves_directly(model))
  {
  }


  template <int dim>
  void
  TangentPreconditioner<dim>::initialize(const Matrix &A, const Vector &displacement)
  {
    multigrid.reset();
    if (direct)
      {
        factorisation.factorise(A);
        return;
      }
    if (!std::isfinite(A.frobenius_norm()))
      throw SolveError("the matrix of the bodies is not a number. Try a smaller step.");
    multigrid = std::make_unique<Multigrid>();
    multigrid->matrix.reinit(A);
    add_matrix(multigrid->matrix, 1, A);
    initialize_multigrid(multigrid->hierarchy, multigrid->matrix, model, displacement);
  }


  template <int dim>
  void
  TangentPreconditioner<dim>::vmult(Vector &x, const Vector &b) const
  {
    if (!multigrid)
      {
        x = factorisation.solve(b);
        return;
      }
    dealii::ReductionControl control(most_iterations, 0., reduction);
    x = 0;
    try
      {
        dealii::SolverCG<Vector>(control).solve(multigrid->matrix, x, b, multigrid->hierarchy);
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        // What there is will do, if it is a number: A may be indefinite.
        if (!std::isfinite(x.l2_norm()))
          multigrid->hierarchy.vmult(x, b);
      }
  }


  template class TangentPreconditioner<2>;
  template class TangentPreconditioner<3>;
} // namespace undine
