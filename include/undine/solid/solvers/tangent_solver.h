// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_solvers_tangent_solver_h
#define undine_solid_solvers_tangent_solver_h

#include <undine/solid/mesh/solid_model.h>
#include <undine/solid/solvers/factorisation.h>
#include <undine/solid/solvers/symmetry.h>
#include <undine/solid/solvers/tangent_multigrid.h>

#include <memory>
#include <string>

namespace undine
{
  /// Solves linear systems with the Jacobian of the bodies' equations, as `Linear solver` says: by
  /// factorisation, or by conjugate gradients with smoothed aggregation (ML) that knows the
  /// rigid-body motions; GMRES takes the place of conjugate gradients where the tangent is not
  /// symmetric. Where the iteration does not converge, as when the tangent is
  /// not positive definite, a factorisation takes its place, with `auto` for the rest of the stage.
  /// The analysis of the sparsity pattern is reused from one system to the next, the multigrid
  /// hierarchy within a stage until the number of iterations a decade has grown by half.
  template <int dim>
  class TangentSolver
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Matrix = typename SolidModel<dim>::Matrix;

    /// `model` must outlive it.
    explicit TangentSolver(const SolidModel<dim> &model);

    /// Systems with A follow, which must outlive them. `displacement` [m] says where the bodies
    /// are.
    void
    initialize(const Matrix &A, const Vector &displacement);

    /// A^{-1} b, or if A is solved iteratively, up to `reduction` of |b|, at least `Linear
    /// tolerance`. Collective. Throws SolveError on all ranks if A is singular or not a number.
    Vector
    solve(const Vector &b, double reduction = 0);

    /// What the last solve() has left of |b| [1]; 0 if factors have solved.
    double
    part_left() const;

    /// Forget iterations(), note() and the hierarchy: what is solved follows from the state alone,
    /// whether a run was resumed or not. Systems that follow have a `symmetry`.
    void
    begin_stage(Symmetry symmetry);

    /// Iterations of the iterative solver since begin_stage().
    unsigned int
    iterations() const;

    /// A note on anything unusual since then; empty if there was nothing.
    const std::string &
    note() const;

  private:
    bool
    is_direct() const;
    /// Improve x. False, on all ranks, if the iteration does not converge.
    bool
    iterate(Vector &x, const Vector &b, double reduction);

    const SolidModel<dim>            &model;
    const bool                        direct;
    Symmetry                          symmetry = Symmetry::symmetric;
    const Matrix                     *matrix   = nullptr;
    Vector                            places; ///< of the bodies with this matrix
    Factorisation                     factorisation;
    bool                              is_factorised = false; ///< the matrix
    std::unique_ptr<TangentMultigrid> multigrid;
    double       first_rate     = 0;     ///< iterations a decade when that was new; 0: it is new
    bool         gave_up        = false; ///< the iteration did not converge once
    unsigned int all_iterations = 0;
    double       left           = 0; ///< part_left()
    std::string  all_notes;
  };
} // namespace undine

#endif
