// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_tangent_solver_h
#define undine_solid_tangent_solver_h

#include <undine/solid/solid_model.h>

#include <string>

namespace undine
{
  /// Solves linear systems with the Jacobian of the bodies' equations, as `Linear solver` says: by
  /// factorisation (MUMPS or KLU through Amesos), or by conjugate gradients with smoothed
  /// aggregation (ML) that knows the rigid-body motions. Where the tangent is not positive
  /// definite, or where follower pressures make it unsymmetric, the second gives way to GMRES and
  /// then to the first.
  template <int dim>
  class TangentSolver
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Matrix = typename SolidModel<dim>::Matrix;

    /// `model` must outlive it.
    explicit TangentSolver(const SolidModel<dim> &model);

    /// A^{-1} b, or if A is solved iteratively, up to a residual |A x - b| that is `negligible`
    /// [N]. `displacement` [m] says where the bodies are. Collective. Throws SolveError if A is
    /// singular.
    Vector
    solve(const Matrix &A, const Vector &b, const Vector &displacement, double negligible = 0);

    /// Of the iterative solver, so far.
    unsigned int
    iterations() const;

    /// What was unusual so far; empty if nothing was.
    const std::string &
    note() const;

  private:
    bool
    is_direct() const;
    Vector
    solve_directly(const Matrix &A, const Vector &b) const;

    const SolidModel<dim> &model;
    const bool             symmetric;
    unsigned int           all_iterations = 0;
    std::string            all_notes;
  };
} // namespace undine

#endif
