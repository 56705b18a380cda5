// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_tangent_multigrid_h
#define undine_solid_tangent_multigrid_h

#include <undine/solid/solid_model.h>

#include <deal.II/lac/trilinos_precondition.h>

namespace undine
{
  /// Is a factorisation what the key `Linear solver` asks for, or with `auto` the cheaper way?
  /// Collective.
  template <int dim>
  bool
  solves_directly(const SolidModel<dim> &model);

  /// Smoothed aggregation (ML) that knows the rigid-body motions of bodies displaced by
  /// `displacement` [m]. A has to live as long as the result. Throws what ML throws.
  template <int dim>
  void
  initialize_multigrid(dealii::TrilinosWrappers::PreconditionAMG    &multigrid,
                       const dealii::TrilinosWrappers::SparseMatrix &A,
                       const SolidModel<dim>                        &model,
                       const typename SolidModel<dim>::Vector       &displacement);
} // namespace undine

#endif
