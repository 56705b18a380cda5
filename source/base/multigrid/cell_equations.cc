// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/multigrid/cell_equations.h>
#include <undine/base/parallel/matrix_row.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <map>

namespace undine
{
  namespace
  {
    using Matrix      = CellEquations::Matrix;
    using Partitioner = CellEquations::Partitioner;

    std::shared_ptr<const Partitioner>
    partitioner_of(const Matrix &matrix)
    {
      const auto       owned = matrix.locally_owned_range_indices();
      dealii::IndexSet ghosts(owned.size());
      const auto      &columns = matrix.trilinos_matrix().ColMap();
      for (int k = 0; k < columns.NumMyElements(); ++k)
        if (!owned.is_element(columns.GID(k)))
          ghosts.add_index(columns.GID(k));
      ghosts.compress();
      return std::make_shared<const Partitioner>(owned, ghosts, matrix.get_mpi_communicator());
    }
  } // namespace


  double
  CellEquations::diagonal(const unsigned int row) const
  {
    double result = outward[row] + rest_diagonal[row];
    for (std::size_t k = row_begins[row]; k < row_begins[row + 1]; ++k)
      result += entries[k].coupling;
    return result;
  }


  void
  CellEquations::exchange_boxes()
  {
    boxes.resize(n_owned() + partitioner->n_ghost_indices());
    dealii::LinearAlgebra::distributed::Vector<double> numbers(partitioner);
    for (const auto ends : {&Box::lower, &Box::upper})
      for (unsigned int axis = 0; axis < 3; ++axis)
        {
          numbers.zero_out_ghost_values();
          for (unsigned int i = 0; i < n_owned(); ++i)
            numbers.local_element(i) = (boxes[i].*ends)[axis];
          numbers.update_ghost_values();
          for (unsigned int i = n_owned(); i < boxes.size(); ++i)
            (boxes[i].*ends)[axis] = static_cast<int>(numbers.local_element(i));
        }
  }


  CellEquations
  make_cell_equations(const Matrix &diffusion, const Matrix &whole, const CellsOfUnknowns &places)
  {
    CellEquations result;
    result.partitioner   = partitioner_of(whole);
    result.planes        = places.planes;
    const unsigned int n = result.n_owned();
    AssertDimension(places.cells.size(), n);
    result.outward.assign(n, 0.);
    result.rest_diagonal.assign(n, 0.);
    result.row_begins.assign(1, 0);
    std::vector<std::pair<unsigned int, double>> in_diffusion;
    for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int row = result.partitioner->local_to_global(i);
        in_diffusion.clear();
        for_each_in_row(diffusion, row, [&](const unsigned int column, const double value) {
          in_diffusion.emplace_back(column, value);
          result.outward[i] += value;
        });
        for_each_in_row(whole, row, [&](const unsigned int column, const double value) {
          const auto   entry        = std::find_if(in_diffusion.begin(),
                                          in_diffusion.end(),
                                          [&](const auto &entry) { return entry.first == column; });
          const double of_diffusion = entry == in_diffusion.end() ? 0. : entry->second;
          if (column == row)
            result.rest_diagonal[i] += value - of_diffusion;
          else if (value != 0)
            result.entries.push_back({result.partitioner->global_to_local(column),
                                      std::max(0., -of_diffusion),
                                      value - of_diffusion});
        });
        result.outward[i] = std::max(0., result.outward[i]);
        result.row_begins.push_back(result.entries.size());
        auto upper = places.cells[i];
        for (int &end : upper)
          ++end;
        result.boxes.push_back({places.cells[i], upper});
      }
    result.exchange_boxes();
    return result;
  }
} // namespace undine
