// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_tangent_preconditioner_h
#define undine_solid_tangent_preconditioner_h

#include <undine/solid/factorisation.h>
#include <undine/solid/solid_model.h>

#include <deal.II/lac/trilinos_precondition.h>

#include <memory>

namespace undine
{
  /// What stands for A^{-1}, A being a Jacobian of the bodies' equations, in a preconditioner: its
  /// factors where solves_directly(), otherwise some steps of conjugate gradients with multigrid,
  /// not always the same: outer iterations must be flexible. The factors do not mind a tangent that
  /// is indefinite (a body that buckles).
  template <int dim>
  class TangentPreconditioner
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Matrix = typename SolidModel<dim>::Matrix;

    /// `model` must outlive it.
    explicit TangentPreconditioner(const SolidModel<dim> &model);

    /// A is kept as a copy. Collective. Throws SolveError if it is singular or not a number.
    void
    initialize(const Matrix &A, const Vector &displacement);

    /// x = about A^{-1} b. Collective.
    void
    vmult(Vector &x, const Vector &b) const;

  private:
    struct Multigrid
    {
      Matrix                                    matrix;
      dealii::TrilinosWrappers::PreconditionAMG hierarchy;
    };

    const SolidModel<dim>     &model;
    const bool                 direct;
    mutable Factorisation      factorisation;
    std::unique_ptr<Multigrid> multigrid; ///< nullptr: there are factors
  };
} // namespace undine

#endif
