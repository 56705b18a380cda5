// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/solid/loads.h>
#include <undine/solid/rigid_motions.h>
#include <undine/solid/tangent_solver.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>

#include <Amesos.h>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <array>

namespace undine
{
  namespace
  {
    /// Smoothed aggregation for the symmetric part of A.
    template <int dim>
    void
    initialize_multigrid(dealii::TrilinosWrappers::PreconditionAMG    &multigrid,
                         const dealii::TrilinosWrappers::SparseMatrix &A,
                         const SolidModel<dim>                        &model,
                         Epetra_MultiVector                           &motions)
    {
      dealii::TrilinosWrappers::PreconditionAMG::AdditionalData data;
      data.elliptic              = true;
      data.higher_order_elements = model.numerics().degree > 1;
      data.smoother_sweeps       = 2;
      data.aggregation_threshold = 1e-2;

      Teuchos::ParameterList              parameters;
      std::unique_ptr<Epetra_MultiVector> no_constant_modes;
      data.set_parameters(parameters, no_constant_modes, A);
      parameters.set("PDE equations", dim);
      parameters.set("null space: type", "pre-computed");
      parameters.set("null space: dimension", motions.NumVectors());
      parameters.set("null space: vectors", motions.Values());
      parameters.set("null space: add default vectors", false);
      multigrid.initialize(A, parameters);
    }


    template <class Solver, int dim>
    unsigned int
    iterate(typename SolidModel<dim>::Vector                &x,
            const dealii::TrilinosWrappers::SparseMatrix    &A,
            const typename SolidModel<dim>::Vector          &b,
            const SolidModel<dim>                           &model,
            const dealii::TrilinosWrappers::PreconditionAMG &multigrid,
            const double                                     negligible,
            const typename Solver::AdditionalData           &data = {})
    {
      const unsigned int    maximum_iterations = 300;
      dealii::SolverControl control(
        maximum_iterations, std::max(negligible, model.numerics().linear_tolerance * b.l2_norm()));
      Solver(control, data).solve(A, x, b, multigrid);
      return control.last_step();
    }


    /// KLU has the smaller overhead, MUMPS works on blocks.
    dealii::TrilinosWrappers::SolverDirect::AdditionalData
    factorisation(const unsigned int n_unknowns)
    {
      const unsigned int few   = 2000;
      const bool         mumps = n_unknowns > few && Amesos().Query("Amesos_Mumps");
      return dealii::TrilinosWrappers::SolverDirect::AdditionalData(
        false, mumps ? "Amesos_Mumps" : "Amesos_Klu");
    }
  } // namespace


  template <int dim>
  TangentSolver<dim>::TangentSolver(const SolidModel<dim> &model)
    : model(model)
    , symmetric(!has_pressure_loads(model))
  {
  }


  template <int dim>
  bool
  TangentSolver<dim>::is_direct() const
  {
    const std::string &choice = model.numerics().linear_solver;
    if (choice != "auto")
      return choice == "direct";
    // Where a factorisation costs as much as multigrid.
    const std::array<unsigned int, 2> most_in_2d_and_3d{{30000, 6000}};
    const bool                        separated =
      std::any_of(model.bodies().begin(), model.bodies().end(), [](auto &body) {
        return body.kinematics->separates_volumetric_part(*body.material);
      });
    return separated || model.dof_handler().n_dofs() <= most_in_2d_and_3d[dim - 2];
  }


  template <int dim>
  typename TangentSolver<dim>::Vector
  TangentSolver<dim>::solve(const Matrix &A,
                            const Vector &b,
                            const Vector &displacement,
                            const double  negligible)
  {
    if (is_direct())
      return solve_directly(A, b);
    auto                                      motions = rigid_motions(model, displacement);
    dealii::TrilinosWrappers::PreconditionAMG multigrid;
    initialize_multigrid(multigrid, A, model, motions);
    using ConjugateGradients = dealii::SolverCG<Vector>;
    using GMRES              = dealii::SolverGMRES<Vector>;
    const typename GMRES::AdditionalData true_residual(100, true); // preconditioned from the right
    Vector                               x = model.vector();
    try
      {
        all_iterations += symmetric
                            ? iterate<ConjugateGradients>(x, A, b, model, multigrid, negligible)
                            : iterate<GMRES>(x, A, b, model, multigrid, negligible, true_residual);
        return x;
      }
    catch (const dealii::SolverControl::NoConvergence &failure)
      {
        all_iterations += failure.last_step;
        all_notes = "multigrid did not converge (the tangent is indefinite, or cells are badly "
                    "shaped): solved directly";
        return solve_directly(A, b);
      }
  }


  template <int dim>
  typename TangentSolver<dim>::Vector
  TangentSolver<dim>::solve_directly(const Matrix &A, const Vector &b) const
  {
    dealii::SolverControl control;
    Vector                x = model.vector();
    try
      {
        dealii::TrilinosWrappers::SolverDirect(control, factorisation(A.m())).solve(A, x, b);
      }
    catch (const dealii::ExceptionBase &)
      {
        throw SolveError("the matrix of the bodies is singular or not a number. Try: clamps that "
                         "leave no rigid motion (static), or a smaller step.");
      }
    return x;
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
