// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_multigrid_cell_equations_h
#define undine_base_multigrid_cell_equations_h

#include <deal.II/base/partitioner.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <array>
#include <memory>
#include <vector>

namespace undine
{
  /// The planes of a grid normal to each direction [m]; 0 and 1 for directions that it has not.
  using PlanesOfCells = std::array<std::vector<double>, 3>;

  /// Where the unknowns of this rank sit: in which cells of a grid, several in one allowed.
  struct CellsOfUnknowns
  {
    std::vector<std::array<int, 3>>      cells; ///< of the owned unknowns, in their order
    std::shared_ptr<const PlanesOfCells> planes;
  };


  /// Equations of unknowns that sit in cells of a grid, or in blocks of such cells,
  ///
  ///     sum_j a_ij (x_i - x_j) + o_i x_i + sum_j R_ij x_j = b_i:
  ///
  /// diffusion with a_ij = a_ji >= 0 between neighbours and o_i >= 0 to where a value is given, and
  /// a symmetric rest R that need not be between neighbours. Numbers of columns are local: owned
  /// unknowns first, then ghosts.
  struct CellEquations
  {
    using Matrix      = dealii::TrilinosWrappers::SparseMatrix;
    using Partitioner = dealii::Utilities::MPI::Partitioner;

    /// Cells lower <= i < upper.
    struct Box
    {
      std::array<int, 3> lower;
      std::array<int, 3> upper;
    };

    /// Off the diagonal.
    struct Entry
    {
      unsigned int column;
      double       coupling; ///< a_ij
      double       rest;     ///< R_ij
    };

    unsigned int
    n_owned() const
    {
      return partitioner->locally_owned_size();
    }

    /// The entry of the matrix on the diagonal.
    double
    diagonal(unsigned int row) const;

    /// [m]
    double
    width(const Box &box, const unsigned int axis) const
    {
      return (*planes)[axis][box.upper[axis]] - (*planes)[axis][box.lower[axis]];
    }

    /// Fetch the boxes of ghosts from their owners. Collective.
    void
    exchange_boxes();

    std::shared_ptr<const Partitioner>   partitioner;
    std::shared_ptr<const PlanesOfCells> planes;
    std::vector<Box>                     boxes;         ///< of the owned unknowns, then of ghosts
    std::vector<std::size_t>             row_begins;    ///< in `entries`; one more than rows
    std::vector<Entry>                   entries;       ///< row by row
    std::vector<double>                  outward;       ///< o_i
    std::vector<double>                  rest_diagonal; ///< R_ii
  };

  /// The equations of the matrix `diffusion` + R, given as a whole: off the diagonal of `diffusion`
  /// is -a_ij. Its pattern must be within that of `whole`, which may be `diffusion` itself.
  /// Collective.
  CellEquations
  make_cell_equations(const CellEquations::Matrix &diffusion,
                      const CellEquations::Matrix &whole,
                      const CellsOfUnknowns       &places);
} // namespace undine

#endif
