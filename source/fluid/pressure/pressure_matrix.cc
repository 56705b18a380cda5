// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/pressure/pressure_gradient.h>
#include <undine/fluid/pressure/pressure_matrix.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <vector>

namespace undine
{
  namespace
  {
    /// Entries of one row.
    template <int dim>
    struct MatrixRow
    {
      using Number = typename PressureNumbers<dim>::Number;

      void
      restart(const Number row)
      {
        columns.assign(1, row);
        values.assign(1, 0.);
      }

      void
      add(const Number column, const double value)
      {
        columns.push_back(column);
        values.push_back(value);
      }

      std::vector<Number> columns; ///< the first one is the diagonal
      std::vector<double> values;
    };


    /// Call `action(row)` for what whole faces add to the row of every whole cell.
    template <int dim, class Action>
    void
    for_each_entry_of_faces(const FluidModel<dim>      &model,
                            const PressureNumbers<dim> &numbers,
                            Action                    &&action)
    {
      using Kind          = typename SubLattice<dim>::Kind;
      const auto    &grid = model.grid();
      const auto    *open = numbers.topology().get();
      MatrixRow<dim> row;
      for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
        if (open && open->cells.kind(cell) != Kind::whole)
          return;
        row.restart(numbers.of_cell(cell));
        for (unsigned int axis = 0; axis < dim; ++axis)
          for (unsigned int end = 0; end < 2; ++end)
            {
              const Side side{axis, end};
              const auto face        = moved<dim>(cell, axis, end);
              const bool at_boundary = grid.at_boundary(axis, face);
              if ((open && open->faces[axis].kind(face) != Kind::whole) ||
                  (at_boundary && !model.boundaries().at(side, cell).is_open()))
                continue;
              const double coupling = pressure_coupling(model, axis, face);
              row.values[0] += coupling;
              if (!at_boundary)
                row.add(numbers.of_cell(moved<dim>(cell, axis, side.sign())), -coupling);
            }
        action(row);
      });
    }


    /// The same for the pieces of divided faces.
    template <int dim, class Action>
    void
    for_each_entry_of_pieces(const FluidModel<dim>      &model,
                             const PressureNumbers<dim> &numbers,
                             Action                    &&action)
    {
      const auto    &open = *numbers.topology();
      const auto    &grid = model.grid();
      MatrixRow<dim> row;
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (std::size_t k = 0; k < open.pieces[axis].size(); ++k)
          {
            const auto &part        = open.faces[axis].all()[k];
            const auto &piece       = open.pieces[axis][k];
            const bool  at_boundary = grid.at_boundary(axis, part.index);
            const Side  side{axis, part.index[axis] == 0 ? 0u : 1u};
            if (at_boundary && !model.boundaries().at(side, part.index).is_open())
              continue;
            const double coupling = part.measure * part.measure / (model.density() * piece.volume);
            for (const unsigned int end : {0, 1})
              {
                // Across periodic sides a rank may know a piece twice, but owns each end once.
                const auto place = end_of_piece(open, axis, k, end);
                if (piece.components[end] == FluidTopology<dim>::outside ||
                    !grid.cells()->owned().contains(place.cell))
                  continue;
                row.restart(numbers.of(place));
                row.values[0] = coupling;
                if (!at_boundary)
                  row.add(numbers.of(end_of_piece(open, axis, k, 1 - end)), -coupling);
                action(row);
              }
          }
    }


    template <int dim, class Action>
    void
    for_each_entry(const FluidModel<dim>      &model,
                   const PressureNumbers<dim> &numbers,
                   Action                    &&action)
    {
      for_each_entry_of_faces(model, numbers, action);
      if (numbers.topology())
        {
          // Components without pieces have a row, too.
          MatrixRow<dim> row;
          for (std::size_t c = 0; c < numbers.topology()->cells.all().size(); ++c)
            if (numbers.topology()->cells.owns(c))
              {
                row.restart(numbers.of_component(c));
                action(row);
              }
          for_each_entry_of_pieces(model, numbers, action);
        }
    }
  } // namespace


  template <int dim>
  void
  build_pressure_matrix(dealii::TrilinosWrappers::SparseMatrix                   &matrix,
                        const FluidModel<dim>                                    &model,
                        const PressureNumbers<dim>                               &numbers,
                        const std::vector<typename PressureNumbers<dim>::Number> &pinned)
  {
    // A rank without fluid must not announce rows: their numbers would be taken for a huge range.
    dealii::TrilinosWrappers::SparsityPattern pattern(
      numbers.owned(), model.grid().communicator(), numbers.owned().is_empty() ? 0 : 2 * dim + 1);
    for_each_entry(model, numbers, [&](const MatrixRow<dim> &row) {
      pattern.add_entries(row.columns[0], row.columns.begin(), row.columns.end());
    });
    pattern.compress();
    matrix.reinit(pattern);
    for_each_entry(model, numbers, [&](const MatrixRow<dim> &row) {
      matrix.add(row.columns[0], row.columns.size(), row.columns.data(), row.values.data(), false);
    });
    matrix.compress(dealii::VectorOperation::add);
    for (const auto row : pinned)
      {
        const double diagonal = matrix.diag_element(row);
        matrix.set(row, row, diagonal == 0 ? 1. : 2 * diagonal);
      }
    matrix.compress(dealii::VectorOperation::insert);
  }


  template void
  build_pressure_matrix(dealii::TrilinosWrappers::SparseMatrix &,
                        const FluidModel<2> &,
                        const PressureNumbers<2> &,
                        const std::vector<PressureNumbers<2>::Number> &);
  template void
  build_pressure_matrix(dealii::TrilinosWrappers::SparseMatrix &,
                        const FluidModel<3> &,
                        const PressureNumbers<3> &,
                        const std::vector<PressureNumbers<3>::Number> &);
} // namespace undine
