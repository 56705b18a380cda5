// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/viscosity/convective_entries.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// The place of a column of this rank in a row.
    unsigned short
    place_in_row(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                 const int                                     row,
                 const int                                     column)
    {
      const auto &epetra  = matrix.trilinos_matrix();
      int         size    = 0;
      double     *values  = nullptr;
      int        *columns = nullptr;
      epetra.ExtractMyRowView(row, size, values, columns);
      const int local_column = epetra.LCID(epetra.GRID(column));
      const int place        = std::find(columns, columns + size, local_column) - columns;
      Assert(place < size, dealii::ExcMessage("the matrix has no such entry"));
      return static_cast<unsigned short>(place);
    }
  } // namespace


  template <int dim>
  void
  ConvectiveEntries<dim>::find(const DualFluxes<dim> &fluxes,
                               const unsigned int     axis,
                               const Matrix          &matrix,
                               const Local           &local)
  {
    pairs.clear();
    fluxes.for_each_between(axis,
                            [&](const FacePlace<dim> &a, const FacePlace<dim> &b, const double) {
                              const int from = local(a), to = local(b);
                              pairs.emplace_back();
                              if (from == none || to == none)
                                return;
                              pairs.back() = {from,
                                              to,
                                              {{place_in_row(matrix, from, from),
                                                place_in_row(matrix, from, to),
                                                place_in_row(matrix, to, from),
                                                place_in_row(matrix, to, to)}}};
                            });
  }


  std::vector<double *>
  rows_of(dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    const auto           &epetra = matrix.trilinos_matrix();
    std::vector<double *> result(epetra.NumMyRows());
    for (int row = 0; row < epetra.NumMyRows(); ++row)
      {
        int  size    = 0;
        int *columns = nullptr;
        epetra.ExtractMyRowView(row, size, result[row], columns);
      }
    return result;
  }


  template class ConvectiveEntries<2>;
  template class ConvectiveEntries<3>;
} // namespace undine
