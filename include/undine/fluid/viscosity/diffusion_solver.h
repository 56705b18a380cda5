// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_diffusion_solver_h
#define undine_fluid_viscosity_diffusion_solver_h

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <algorithm>
#include <memory>

namespace undine
{
  /// Conjugate gradients for the symmetric positive definite matrices of implicit diffusion, or
  /// GMRES if they contain convection, of which the symmetric part is that of the former.
  class DiffusionSolver
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// From this h nu / dx^2 on a step reaches over so many cells that a hierarchy of grids pays.
    static constexpr double far = 30;

    enum class Matrices
    {
      symmetric,
      with_convection
    };

    /// The residual at which iterations end, for a right side of the norm `load`: tight, so that
    /// rank counts agree; a load of zero has the solution zero.
    static double
    tolerance(const double load)
    {
      return std::max(1e-12 * load, 1e-300);
    }

    /// To be filled; then call set_up().
    dealii::TrilinosWrappers::SparseMatrix matrix;

    /// Prepare the preconditioner for `matrix`. `diffusion_number`: the largest
    /// h nu / dx^2 [1], the same on all ranks; it decides between relaxation and, where a step
    /// reaches over many cells, multigrid. Collective.
    void
    set_up(double diffusion_number, Matrices matrices = Matrices::symmetric);

    /// Solve for the right side `load`, starting from `solution`. Returns the number of iterations.
    /// Throws SolveError if they do not converge. Collective.
    unsigned int
    solve(Vector &solution, const Vector &load) const;

    /// About matrix^{-1} b, for solvers of more than this.
    void
    precondition(Vector &x, const Vector &b) const;

    /// By the diagonal until set_up(): incomplete factors fail where the flow crosses many cells in
    /// a step.
    void
    precondition_by_diagonal();

    /// The same by sparse factors of what couples the unknowns of each rank: dear, but good for a
    /// flow that crosses ever so many cells in a step.
    void
    precondition_by_factors();

    /// Memory of matrix and hierarchy on this rank [bytes].
    std::size_t
    memory_consumption() const;

  private:
    unsigned int
    solve_with_convection(Vector &solution, const Vector &load) const;

    std::unique_ptr<dealii::TrilinosWrappers::PreconditionBase> preconditioner;
    Matrices                                                    matrices = Matrices::symmetric;
  };
} // namespace undine

#endif
