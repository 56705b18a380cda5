// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/solid/solvers/tangent_preconditioner.h>

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
    , direct(solves_directly(model, FactorUse::preconditioner))
  {
  }


  template <int dim>
  void
  TangentPreconditioner<dim>::initialize(const Matrix &A, const Vector &displacement)
  {
    last_note.clear();
    multigrid.reset();
    if (direct)
      {
        factorisation.factorise(A);
        return;
      }
    if (!std::isfinite(A.frobenius_norm()))
      throw SolveError("the matrix of the bodies is not a number. Try a smaller step.");
    multigrid = make_multigrid(A, model, displacement);
    if (!multigrid)
      give_way(A);
  }


  template <int dim>
  void
  TangentPreconditioner<dim>::give_way(const Matrix &A)
  {
    factorisation.factorise(A);
    multigrid.reset();
    last_note = "multigrid does not serve the bodies (their tangent is indefinite, as when they "
                "buckle): their matrix is factorised";
  }


  template <int dim>
  void
  TangentPreconditioner<dim>::vmult(Vector &x, const Vector &b)
  {
    if (multigrid && iterate(x, b))
      return;
    if (multigrid)
      give_way(multigrid->matrix);
    x = factorisation.solve(b);
  }


  template <int dim>
  bool
  TangentPreconditioner<dim>::iterate(Vector &x, const Vector &b) const
  {
    dealii::ReductionControl control(most_iterations, 0., reduction);
    dealii::SolverCG<Vector> solver(control);
    bool                     indefinite = false;
    solver.connect_coefficients_slot(
      [&](const double step_length, const double) { indefinite |= !(step_length > 0); });
    x = 0;
    try
      {
        solver.solve(multigrid->matrix, x, b, multigrid->hierarchy);
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        // What there is will do, if nothing but the number of steps was against it.
        return !indefinite && std::isfinite(x.l2_norm());
      }
    return true;
  }


  template <int dim>
  const std::string &
  TangentPreconditioner<dim>::note() const
  {
    return last_note;
  }


  template class TangentPreconditioner<2>;
  template class TangentPreconditioner<3>;
} // namespace undine
