// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_solvers_tangent_preconditioner_h
#define undine_solid_solvers_tangent_preconditioner_h

#include <undine/solid/mesh/solid_model.h>
#include <undine/solid/solvers/factorisation.h>
#include <undine/solid/solvers/tangent_multigrid.h>

#include <memory>
#include <string>

namespace undine
{
  /// An approximation of A^{-1}, A being a Jacobian of the bodies' equations, for preconditioners:
  /// its factors where solves_directly(), otherwise some steps of conjugate gradients with
  /// multigrid. These are no fixed linear operator: outer iterations must be flexible. Factors also
  /// serve a tangent that is indefinite (a body that buckles); conjugate gradients that meet a
  /// direction in which it is not positive, and do not converge, are replaced by them until the
  /// next matrix comes.
  template <int dim>
  class TangentPreconditioner
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Matrix = typename SolidModel<dim>::Matrix;

    /// `model` must outlive it.
    explicit TangentPreconditioner(const SolidModel<dim> &model);

    /// Copies A; `displacement` [m] says where the bodies are. Collective. Throws SolveError if it
    /// is singular or not a number.
    void
    initialize(const Matrix &A, const Vector &displacement);

    /// x = about A^{-1} b. Collective. Throws as initialize() does.
    void
    vmult(Vector &x, const Vector &b);

    /// A note on anything unusual since initialize(); empty if there was nothing.
    const std::string &
    note() const;

  private:
    /// Replace the multigrid of a matrix by factors of it.
    void
    give_way(const Matrix &A);

    /// False, on all ranks, if x is of no use.
    bool
    iterate(Vector &x, const Vector &b) const;

    const SolidModel<dim>            &model;
    const bool                        direct;
    Factorisation                     factorisation;
    std::unique_ptr<TangentMultigrid> multigrid; ///< nullptr: there are factors
    std::string                       last_note;
  };
} // namespace undine

#endif
