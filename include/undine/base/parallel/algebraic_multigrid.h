// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_parallel_algebraic_multigrid_h
#define undine_base_parallel_algebraic_multigrid_h

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Teuchos_ParameterList.hpp>

namespace undine
{
  /// dealii::TrilinosWrappers::PreconditionAMG, whose hierarchy depends on the matrix and the
  /// number of ranks alone. ML estimates eigenvalues from random vectors, whose numbers go on from
  /// one hierarchy to the next: what a solver leaves would depend on how many have been made
  /// before, and a run that is resumed would differ from one that is not.
  class AlgebraicMultigrid : public dealii::TrilinosWrappers::PreconditionAMG
  {
  public:
    /// For one unknown in a cell, coupled to its neighbours as by diffusion. Collective. Throws
    /// what ML throws.
    void
    initialize(const dealii::TrilinosWrappers::SparseMatrix &matrix);

    /// With ML's parameters.
    void
    initialize(const dealii::TrilinosWrappers::SparseMatrix &matrix,
               const Teuchos::ParameterList                 &parameters);
  };
} // namespace undine

#endif
