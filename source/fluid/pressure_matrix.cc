// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/pressure_gradient.h>
#include <undine/fluid/pressure_matrix.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <vector>

namespace undine
{
  namespace
  {
    using Number = dealii::types::global_dof_index;

    /// One row of L; the first column is the diagonal, columns may occur several times.
    struct MatrixRow
    {
      std::vector<Number> columns;
      std::vector<double> values;

      void
      add(const Number column, const double value)
      {
        columns.push_back(column);
        values.push_back(value);
      }
    };


    /// What the faces of `cell` contribute to its row.
    template <int dim>
    void
    collect(MatrixRow &row, const FluidModel<dim> &model, const GridIndex<dim> &cell)
    {
      const auto &grid    = model.grid();
      const auto &lattice = *grid.cells();
      row.columns.clear();
      row.values.clear();
      row.add(lattice.number(cell), 0);
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (unsigned int end = 0; end < 2; ++end)
          {
            const Side side{axis, end};
            const auto face        = moved<dim>(cell, axis, end);
            const bool at_boundary = grid.at_boundary(axis, face);
            if (at_boundary && !model.boundaries().at(side, cell).is_open())
              continue;
            const double coupling = pressure_coupling(model, axis, face);
            row.values[0] += coupling;
            if (!at_boundary)
              row.add(lattice.number(moved<dim>(cell, axis, side.sign())), -coupling);
          }
    }


    template <int dim>
    dealii::TrilinosWrappers::SparsityPattern
    pattern(const FluidModel<dim> &model)
    {
      const auto                               &lattice = *model.grid().cells();
      dealii::TrilinosWrappers::SparsityPattern result(
        lattice.owned_numbers(), model.grid().communicator(), 2 * dim + 1);
      MatrixRow row;
      for_each(lattice.owned(), [&](const GridIndex<dim> &cell) {
        collect(row, model, cell);
        result.add_entries(row.columns[0], row.columns.begin(), row.columns.end());
      });
      result.compress();
      return result;
    }
  } // namespace


  template <int dim>
  void
  build_pressure_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix,
                        const FluidModel<dim>                  &model)
  {
    const auto &lattice = *model.grid().cells();
    matrix.reinit(pattern(model));
    MatrixRow row;
    for_each(lattice.owned(), [&](const GridIndex<dim> &cell) {
      collect(row, model, cell);
      if (row.columns[0] == 0 && !model.boundaries().has_opening())
        row.values[0] *= 2;
      matrix.add(row.columns[0], row.columns.size(), row.columns.data(), row.values.data(), false);
    });
    matrix.compress(dealii::VectorOperation::add);
  }


  template void
  build_pressure_matrix(dealii::TrilinosWrappers::SparseMatrix &, const FluidModel<2> &);
  template void
  build_pressure_matrix(dealii::TrilinosWrappers::SparseMatrix &, const FluidModel<3> &);
} // namespace undine
