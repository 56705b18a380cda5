// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/solvers/tangent_solver.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  template <int dim>
  TangentSolver<dim>::TangentSolver(const SolidModel<dim> &model)
    : model(model)
    , direct(solves_directly(model, FactorUse::a_few_solves))
  {
  }


  template <int dim>
  bool
  TangentSolver<dim>::is_direct() const
  {
    return direct || (gave_up && model.numerics().linear_solver == "auto");
  }


  template <int dim>
  void
  TangentSolver<dim>::initialize(const Matrix &A, const Vector &displacement)
  {
    matrix        = &A;
    places        = displacement;
    is_factorised = false;
  }


  template <int dim>
  typename TangentSolver<dim>::Vector
  TangentSolver<dim>::solve(const Vector &b, const double reduction)
  {
    if (!is_direct())
      {
        // First with the hierarchy of an earlier matrix, if there is one.
        Vector x = model.vector();
        if (multigrid && iterate(x, b, reduction))
          return x;
        multigrid  = make_multigrid(*matrix, model, places);
        first_rate = 0;
        x          = 0;
        if (multigrid && iterate(x, b, reduction))
          return x;
        multigrid.reset();
        gave_up   = true;
        all_notes = "multigrid did not converge (the tangent is indefinite, or cells are badly "
                    "shaped): solved directly";
      }
    if (!is_factorised)
      factorisation.factorise(*matrix);
    is_factorised = true;
    left          = 0;
    return factorisation.solve(b);
  }


  template <int dim>
  bool
  TangentSolver<dim>::iterate(Vector &x, const Vector &b, const double reduction)
  {
    const unsigned int    maximum_iterations = 300;
    const double          part = std::max(reduction, model.numerics().linear_tolerance);
    dealii::SolverControl control(maximum_iterations, part * b.l2_norm());
    bool                  failed = false;
    try
      {
        using GMRES = dealii::SolverGMRES<Vector>;
        if (symmetry == Symmetry::symmetric)
          dealii::SolverCG<Vector>(control).solve(*matrix, x, b, multigrid->hierarchy);
        else
          GMRES(control, typename GMRES::AdditionalData(100, true)) // preconditioned from the right
            .solve(*matrix, x, b, multigrid->hierarchy);
      }
    catch (const std::exception &)
      {
        failed = true;
      }
    left = control.last_value() / control.initial_value();
    all_iterations += control.last_step();
    if (dealii::Utilities::MPI::logical_or(failed, model.communicator()))
      return false;
    const double decades = std::max(-std::log10(part), 1.);
    const double rate    = std::max(control.last_step(), 1u) / decades;
    if (first_rate == 0)
      first_rate = rate;
    else if (rate > 1.5 * first_rate + 2 / decades)
      multigrid.reset();
    return true;
  }


  template <int dim>
  double
  TangentSolver<dim>::part_left() const
  {
    return left;
  }


  template <int dim>
  void
  TangentSolver<dim>::begin_stage(const Symmetry new_symmetry)
  {
    symmetry = new_symmetry;
    multigrid.reset();
    gave_up        = false;
    all_iterations = 0;
    all_notes.clear();
  }


  template <int dim>
  unsigned int
  TangentSolver<dim>::iterations() const
  {
    return all_iterations;
  }


  template <int dim>
  const std::string &
  TangentSolver<dim>::note() const
  {
    return all_notes;
  }


  template class TangentSolver<2>;
  template class TangentSolver<3>;
} // namespace undine
