// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_cell_matrix_adder_h
#define undine_solid_assembly_cell_matrix_adder_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <utility>
#include <vector>

namespace undine
{
  /// Adds the matrices of cells to a sparse matrix, row by row: entries of this rank are found by
  /// walking along those of the row, which are sorted, instead of one by one.
  class CellMatrixAdder
  {
  public:
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;
    using Index  = dealii::types::global_dof_index;

    /// The matrix has its pattern and must outlive this.
    explicit CellMatrixAdder(Matrix &matrix);

    /// `values` in rows and columns `dofs`, which must be in the pattern; what belongs to other
    /// ranks gets there by compress(). Not collective.
    void
    add(const std::vector<Index> &dofs, const dealii::FullMatrix<double> &values);

  private:
    Matrix                                   &matrix;
    std::vector<std::pair<int, unsigned int>> columns; ///< of a cell: in the matrix, in `dofs`
  };
} // namespace undine

#endif
