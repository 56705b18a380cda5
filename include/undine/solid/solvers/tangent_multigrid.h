// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_solvers_tangent_multigrid_h
#define undine_solid_solvers_tangent_multigrid_h

#include <undine/base/parallel/algebraic_multigrid.h>
#include <undine/solid/mesh/solid_model.h>
#include <undine/solid/solvers/factorisation_work.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>

namespace undine
{
  /// Does the key `Linear solver` ask for a factorisation, or is it, with `auto`, the cheaper
  /// method for this use (factorisation_work())? Collective.
  template <int dim>
  bool
  solves_directly(const SolidModel<dim> &model, FactorUse use);

  /// Smoothed aggregation (ML) that knows the rigid-body motions, and the matrix it was made for.
  struct TangentMultigrid
  {
    dealii::TrilinosWrappers::SparseMatrix matrix;
    AlgebraicMultigrid                     hierarchy;
  };

  /// For a copy of A, bodies being displaced by `displacement` [m]. nullptr, on all ranks, if A is
  /// not a number or no hierarchy can be made. Collective.
  template <int dim>
  std::unique_ptr<TangentMultigrid>
  make_multigrid(const dealii::TrilinosWrappers::SparseMatrix &A,
                 const SolidModel<dim>                        &model,
                 const typename SolidModel<dim>::Vector       &displacement);
} // namespace undine

#endif
