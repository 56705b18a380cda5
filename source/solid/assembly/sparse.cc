// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/sparse.h>

#include <deal.II/base/exceptions.h>

#include <Epetra_CrsGraph.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_Vector.h>

#include <algorithm>

namespace undine
{
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  namespace
  {
    /// The locally owned rows as compressed rows; indices are local ones.
    struct Rows
    {
      explicit Rows(const Matrix &matrix)
        : epetra(matrix.trilinos_matrix())
      {
        const int error = epetra.ExtractCrsDataPointers(starts, columns, values);
        AssertThrow(error == 0, dealii::ExcTrilinosError(error));
      }

      const Epetra_CrsMatrix &epetra;
      int                    *starts;
      int                    *columns;
      double                 *values;
    };


    double
    mean_diagonal(const Matrix &matrix)
    {
      Epetra_Vector diagonal(matrix.trilinos_matrix().RowMap());
      const int     error = matrix.trilinos_matrix().ExtractDiagonalCopy(diagonal);
      AssertThrow(error == 0, dealii::ExcTrilinosError(error));
      double sum = 0;
      diagonal.Norm1(&sum);
      return sum / matrix.m();
    }
  } // namespace


  bool
  same_pattern(const Matrix &A, const Matrix &B)
  {
    const Rows a(A), b(B);
    const int  n_rows = a.epetra.NumMyRows();
    // Matrices that were made from one another share their graph.
    const bool shared = a.epetra.Graph().DataPtr() == b.epetra.Graph().DataPtr();
    bool       same   = shared || (n_rows == b.epetra.NumMyRows() &&
                           std::equal(a.starts, a.starts + n_rows + 1, b.starts));
    for (int entry = 0; same && !shared && entry < a.epetra.NumMyNonzeros(); ++entry)
      same = a.epetra.GCID(a.columns[entry]) == b.epetra.GCID(b.columns[entry]);
    return !dealii::Utilities::MPI::logical_or(!same, A.get_mpi_communicator());
  }


  void
  add_entries(dealii::DynamicSparsityPattern &pattern, const Matrix &A)
  {
    const Rows                                   rows(A);
    std::vector<dealii::types::global_dof_index> columns;
    for (int row = 0; row < rows.epetra.NumMyRows(); ++row)
      {
        columns.clear();
        for (int entry = rows.starts[row]; entry < rows.starts[row + 1]; ++entry)
          columns.push_back(rows.epetra.GCID(rows.columns[entry]));
        pattern.add_entries(rows.epetra.GRID(row), columns.begin(), columns.end());
      }
  }


  std::vector<int>
  places_of_entries(const Matrix &A, const Matrix &larger)
  {
    const Rows       from(A), to(larger);
    std::vector<int> local_column(from.epetra.NumMyCols());
    for (int column = 0; column < from.epetra.NumMyCols(); ++column)
      local_column[column] = to.epetra.LCID(from.epetra.GCID(column));
    std::vector<int> result(from.epetra.NumMyNonzeros());
    for (int row = 0; row < from.epetra.NumMyRows(); ++row)
      {
        const int *const begin = to.columns + to.starts[row];
        const int *const end   = to.columns + to.starts[row + 1];
        for (int entry = from.starts[row]; entry < from.starts[row + 1]; ++entry)
          {
            const int *const place = std::find(begin, end, local_column[from.columns[entry]]);
            AssertThrow(place != end, dealii::ExcMessage("The larger matrix lacks an entry."));
            result[entry] = place - to.columns;
          }
      }
    return result;
  }


  void
  enlarge(Matrix &A, const Matrix &larger, const std::vector<int> &places)
  {
    const Rows                from(A);
    const std::vector<double> values(from.values, from.values + from.epetra.NumMyNonzeros());
    AssertThrow(values.size() == places.size(), dealii::ExcMessage("Not the places of A."));
    A.reinit(larger);
    A = 0;
    const Rows to(A);
    for (unsigned int entry = 0; entry < values.size(); ++entry)
      to.values[places[entry]] = values[entry];
  }


  void
  fix_rows_and_columns(Matrix &A, const dealii::IndexSet &fixed)
  {
    const double      mean     = mean_diagonal(A);
    const double      diagonal = mean > 0 ? mean : 1;
    const Rows        rows(A);
    std::vector<bool> fixed_column(rows.epetra.NumMyCols());
    for (int column = 0; column < rows.epetra.NumMyCols(); ++column)
      fixed_column[column] = fixed.is_element(rows.epetra.GCID(column));
    for (int row = 0; row < rows.epetra.NumMyRows(); ++row)
      {
        const int  index     = rows.epetra.GRID(row);
        const bool fixed_row = fixed.is_element(index);
        for (int entry = rows.starts[row]; entry < rows.starts[row + 1]; ++entry)
          if (fixed_row || fixed_column[rows.columns[entry]])
            rows.values[entry] =
              fixed_row && rows.epetra.GCID(rows.columns[entry]) == index ? diagonal : 0;
      }
  }
} // namespace undine
