// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/parallel/algebraic_multigrid.h>
#include <undine/fluid/viscosity/diffusion_solver.h>

#include <deal.II/lac/solver_bicgstab.h>
#include <deal.II/lac/solver_cg.h>

#include <fmt/format.h>

#include <algorithm>

namespace undine
{
  void
  DiffusionSolver::set_up(const double diffusion_number, const Matrices of)
  {
    namespace Trilinos = dealii::TrilinosWrappers;
    matrices           = of;
    if (matrices == Matrices::with_convection && diffusion_number < 30)
      {
        auto factors = std::make_unique<Trilinos::PreconditionILU>();
        factors->initialize(matrix);
        preconditioner = std::move(factors);
        return;
      }
    // Friction that reaches over a few cells in a step is cheaper to solve for without a hierarchy.
    if (diffusion_number < 30)
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


  unsigned int
  DiffusionSolver::solve(Vector &solution, const Vector &load) const
  {
    // Tight, so that rank counts agree; a load of zero has the solution zero.
    dealii::SolverControl control(1000, std::max(1e-12 * load.l2_norm(), 1e-300));
    try
      {
        if (matrices == Matrices::symmetric)
          dealii::SolverCG<Vector>(control).solve(matrix, solution, load, *preconditioner);
        else
          dealii::SolverBicgstab<Vector>(control).solve(matrix, solution, load, *preconditioner);
      }
    catch (const dealii::SolverControl::NoConvergence &failure)
      {
        throw SolveError(fmt::format("The fluid's implicit terms did not converge in {} "
                                     "iterations. Try a smaller step.",
                                     failure.last_step));
      }
    return control.last_step();
  }


  std::size_t
  DiffusionSolver::memory_consumption() const
  {
    // deal.II knows the size of a hierarchy's finest matrix, and of relaxation nothing.
    const auto *multigrid = dynamic_cast<const AlgebraicMultigrid *>(preconditioner.get());
    return matrix.memory_consumption() + (multigrid ? multigrid->memory_consumption() : 0);
  }
} // namespace undine
