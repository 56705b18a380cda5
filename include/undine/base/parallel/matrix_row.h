// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_parallel_matrix_row_h
#define undine_base_parallel_matrix_row_h

#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace undine
{
  /// Call action(column, value) for the entries of a row of this rank, both numbered globally. In
  /// time proportional to their number, while each comparison of the matrix's own iterators copies
  /// a row.
  template <class Action>
  void
  for_each_in_row(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                  const dealii::types::global_dof_index         row,
                  const Action                                 &action)
  {
    const auto &epetra  = matrix.trilinos_matrix();
    int         size    = 0;
    double     *values  = nullptr;
    int        *columns = nullptr;
    epetra.ExtractMyRowView(epetra.LRID(static_cast<int>(row)), size, values, columns);
    for (int k = 0; k < size; ++k)
      action(static_cast<dealii::types::global_dof_index>(epetra.ColMap().GID(columns[k])),
             values[k]);
  }
} // namespace undine

#endif
