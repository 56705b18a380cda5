// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_blocks_h
#define undine_fluid_grid_blocks_h

#include <undine/fluid/grid/index_box.h>

#include <deal.II/base/mpi.h>

#include <array>

namespace undine
{
  /// Which rank owns which cells: the grid is divided into a box of blocks, one a rank, with the
  /// fewest cell faces between them. Depends on the number of cells and ranks only.
  template <int dim>
  class Blocks
  {
  public:
    /// Throws InputError if there are more ranks than the grid can be cut into.
    Blocks(const MPI_Comm              communicator,
           const GridIndex<dim>       &n_cells,
           const std::array<bool, dim> periodic);

    MPI_Comm
    communicator() const;

    unsigned int
    n_ranks() const;

    /// The rank that runs this.
    unsigned int
    rank() const;

    /// Number of cells of the whole grid in each direction.
    const GridIndex<dim> &
    n_cells() const;

    /// Is the domain periodic along `axis`?
    bool
    periodic(const unsigned int axis) const;

    /// How many blocks there are in each direction.
    const GridIndex<dim> &
    n_blocks() const;

    /// First cell of block `block` along `axis`; block = n_blocks gives the number of cells.
    int
    first_cell(const unsigned int axis, const int block) const;

    /// Which block holds cell `cell` along `axis`.
    int
    block_of_cell(const unsigned int axis, const int cell) const;

    /// Position of the block of a rank among n_blocks().
    GridIndex<dim>
    block_of_rank(const unsigned int rank) const;

    /// The inverse of block_of_rank().
    unsigned int
    rank_of_block(const GridIndex<dim> &block) const;

    /// The cells of a rank.
    IndexBox<dim>
    cells_of_rank(const unsigned int rank) const;

  private:
    MPI_Comm              mpi_communicator;
    unsigned int          my_rank;
    unsigned int          number_of_ranks;
    GridIndex<dim>        cells;
    std::array<bool, dim> is_periodic;
    GridIndex<dim>        blocks;
  };
} // namespace undine

#endif
