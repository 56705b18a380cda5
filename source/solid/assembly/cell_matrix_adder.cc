// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/cell_matrix_adder.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    using EpetraIndex = dealii::TrilinosWrappers::types::int_type;
  }


  CellMatrixAdder::CellMatrixAdder(Matrix &matrix)
    : matrix(matrix)
  {
  }


  void
  CellMatrixAdder::add(const std::vector<Index> &dofs, const dealii::FullMatrix<double> &values)
  {
    const auto &entries = matrix.trilinos_matrix();
    columns.clear();
    for (unsigned int k = 0; k < dofs.size(); ++k)
      columns.emplace_back(entries.ColMap().LID(static_cast<EpetraIndex>(dofs[k])), k);
    std::sort(columns.begin(), columns.end());
    for (unsigned int k = 0; k < dofs.size(); ++k)
      {
        const int row = entries.RowMap().LID(static_cast<EpetraIndex>(dofs[k]));
        if (row < 0)
          {
            matrix.add(dofs[k], dofs.size(), dofs.data(), &values(k, 0), false);
            continue;
          }
        int     n       = 0;
        double *sums    = nullptr;
        int    *numbers = nullptr;
        entries.ExtractMyRowView(row, n, sums, numbers);
        const int *const end = numbers + n;
        for (const auto &[column, place] : columns)
          {
            while (numbers != end && *numbers < column)
              ++numbers, ++sums;
            AssertThrow(numbers != end && *numbers == column, dealii::ExcInternalError());
            *sums += values(k, place);
          }
      }
  }
} // namespace undine
