// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_matrix_h
#define undine_fluid_pressure_matrix_h

#include <undine/fluid/fluid_model.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace undine
{
  /// L = D (rho V)^-1 D^T, face by face: a face between two cells adds a^2/(rho V) [[1,-1],[-1,1]]
  /// to their rows, one on an opening a^2/(rho V) to the cell inside. Rows are the numbers of the
  /// cell lattice.
  ///
  /// Without opening L has the constant as its kernel. Then L_00 is added to the diagonal of row 0:
  /// for right sides whose entries sum to zero the solution is unchanged but has p_0 = 0.
  template <int dim>
  dealii::TrilinosWrappers::SparseMatrix
  pressure_matrix(const FluidModel<dim> &model);
} // namespace undine

#endif
