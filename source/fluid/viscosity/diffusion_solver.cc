// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/parallel/algebraic_multigrid.h>
#include <undine/fluid/viscosity/diffusion_solver.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <fmt/format.h>

namespace undine
{
  void
  DiffusionSolver::set_up(const double diffusion_number, const Matrices of)
  {
    namespace Trilinos = dealii::TrilinosWrappers;
    matrices           = of;
    if (matrices == Matrices::with_convection && diffusion_number < far)
      {
        auto factors = std::make_unique<Trilinos::PreconditionILU>();
        factors->initialize(matrix);
        preconditioner = std::move(factors);
        return;
      }
    // Friction that reaches over a few cells in a step is cheaper to solve for without a hierarchy.
    if (diffusion_number < far)
      {
        auto relaxation = std::make_unique<Trilinos::PreconditionSSOR>();
        relaxation->initialize(matrix);
        preconditioner = std::move(relaxation);
        return;
      }
    auto multigrid = std::make_unique<AlgebraicMultigrid>();
    multigrid->initialize(matrix);
    preconditioner = std::move(multigrid);
  }


  namespace
  {
    /// Short recurrences break down where convection, a skew-symmetric matrix, dominates. Returns
    /// the number of iterations. Throws NoConvergence.
    template <class Preconditioner>
    unsigned int
    solve_by_gmres(DiffusionSolver::Vector                      &solution,
                   const DiffusionSolver::Vector                &load,
                   const dealii::TrilinosWrappers::SparseMatrix &matrix,
                   const Preconditioner                         &preconditioner,
                   const unsigned int                            most_iterations)
    {
      using Gmres = dealii::SolverGMRES<DiffusionSolver::Vector>;
      dealii::SolverControl control(most_iterations, DiffusionSolver::tolerance(load.l2_norm()));
      Gmres(control, Gmres::AdditionalData(120, true))
        .solve(matrix, solution, load, preconditioner);
      return control.last_step();
    }
  } // namespace


  /// Incomplete factors fail where the flow crosses many cells in a step; the diagonal then serves,
  /// or else complete factors.
  unsigned int
  DiffusionSolver::solve_with_convection(Vector &solution, const Vector &load) const
  {
    constexpr unsigned int with_factors = 100, with_diagonal = 1000, most = 100;
    const Vector           guess = solution;
    try
      {
        return solve_by_gmres(solution, load, matrix, *preconditioner, with_factors);
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        solution = guess;
      }
    try
      {
        dealii::TrilinosWrappers::PreconditionJacobi diagonal;
        diagonal.initialize(matrix);
        return with_factors + solve_by_gmres(solution, load, matrix, diagonal, with_diagonal);
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        solution = guess;
      }
    dealii::TrilinosWrappers::PreconditionBlockwiseDirect factors;
    factors.initialize(matrix);
    return with_factors + with_diagonal + solve_by_gmres(solution, load, matrix, factors, most);
  }


  unsigned int
  DiffusionSolver::solve(Vector &solution, const Vector &load) const
  {
    try
      {
        if (matrices == Matrices::with_convection)
          return solve_with_convection(solution, load);
        dealii::SolverControl control(1000, tolerance(load.l2_norm()));
        dealii::SolverCG<Vector>(control).solve(matrix, solution, load, *preconditioner);
        return control.last_step();
      }
    catch (const dealii::SolverControl::NoConvergence &failure)
      {
        throw SolveError(fmt::format("The fluid's implicit terms did not converge in {} "
                                     "iterations. Try a smaller step.",
                                     failure.last_step));
      }
  }


  void
  DiffusionSolver::precondition(Vector &x, const Vector &b) const
  {
    preconditioner->vmult(x, b);
  }


  void
  DiffusionSolver::precondition_by_diagonal()
  {
    auto diagonal = std::make_unique<dealii::TrilinosWrappers::PreconditionJacobi>();
    diagonal->initialize(matrix);
    preconditioner = std::move(diagonal);
  }


  void
  DiffusionSolver::precondition_by_factors()
  {
    auto factors = std::make_unique<dealii::TrilinosWrappers::PreconditionBlockwiseDirect>();
    factors->initialize(matrix);
    preconditioner = std::move(factors);
  }


  std::size_t
  DiffusionSolver::memory_consumption() const
  {
    // deal.II knows the size of a hierarchy's finest matrix, and of relaxation nothing.
    const auto *multigrid = dynamic_cast<const AlgebraicMultigrid *>(preconditioner.get());
    return matrix.memory_consumption() + (multigrid ? multigrid->memory_consumption() : 0);
  }
} // namespace undine
