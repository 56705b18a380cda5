// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_matrix_h
#define undine_fluid_pressure_matrix_h

#include <undine/fluid/fluid_model.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace undine
{
  /// Build L = D (rho V)^-1 D^T, face by face: a face between two cells adds a^2/(rho V) to the
  /// diagonal of each and couples them by minus that; one on an opening adds a^2/(rho V) to the
  /// diagonal of the cell inside. Rows are the numbers of the cell lattice. Collective.
  ///
  /// Without opening L has the constant as its kernel. Then L_00 is added to the diagonal of row 0:
  /// for right sides whose entries sum to zero the solution is one of the original equation, the
  /// one with p_0 = 0.
  template <int dim>
  void
  build_pressure_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix,
                        const FluidModel<dim>                  &model);
} // namespace undine

#endif
