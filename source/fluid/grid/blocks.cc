// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/fluid/grid/blocks.h>

#include <cstdint>
#include <string>

namespace undine
{
  namespace
  {
    /// Cell faces between blocks.
    template <int dim>
    std::int64_t
    interface_size(const GridIndex<dim> &n_cells, const GridIndex<dim> &n_blocks)
    {
      std::int64_t faces = 0;
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          std::int64_t cross_section = 1;
          for (unsigned int d = 0; d < dim; ++d)
            cross_section *= d == axis ? 1 : n_cells[d];
          faces += (n_blocks[axis] - 1) * cross_section;
        }
      return faces;
    }


    /// Try every way to write the number of ranks left as a product over the directions below
    /// `n_axes`. Among equals the first found wins: cuts across the last direction, whose layers
    /// are contiguous in memory.
    template <int dim>
    void
    search_cuts(GridIndex<dim>       &best,
                std::int64_t         &smallest,
                GridIndex<dim>        trial,
                const GridIndex<dim> &n_cells,
                const unsigned int    n_axes,
                const int             ranks_left)
    {
      if (n_axes == 0)
        {
          const auto size = interface_size<dim>(n_cells, trial);
          if (ranks_left == 1 && (smallest < 0 || size < smallest))
            {
              best     = trial;
              smallest = size;
            }
          return;
        }
      for (int pieces = std::min(ranks_left, n_cells[n_axes - 1]); pieces >= 1; --pieces)
        if (ranks_left % pieces == 0)
          {
            trial[n_axes - 1] = pieces;
            search_cuts<dim>(best, smallest, trial, n_cells, n_axes - 1, ranks_left / pieces);
          }
    }
  } // namespace


  template <int dim>
  Blocks<dim>::Blocks(const MPI_Comm              communicator,
                      const GridIndex<dim>       &n_cells,
                      const std::array<bool, dim> periodic)
    : mpi_communicator(communicator)
    , my_rank(dealii::Utilities::MPI::this_mpi_process(communicator))
    , number_of_ranks(dealii::Utilities::MPI::n_mpi_processes(communicator))
    , cells(n_cells)
    , is_periodic(periodic)
  {
    std::int64_t smallest = -1;
    search_cuts<dim>(blocks, smallest, GridIndex<dim>{}, cells, dim, number_of_ranks);
    if (smallest < 0)
      throw InputError("The fluid's grid is too coarse to be cut into " +
                       std::to_string(number_of_ranks) +
                       " blocks, one for each rank. Use fewer ranks or more cells.");
  }


  template <int dim>
  MPI_Comm
  Blocks<dim>::communicator() const
  {
    return mpi_communicator;
  }


  template <int dim>
  unsigned int
  Blocks<dim>::n_ranks() const
  {
    return number_of_ranks;
  }


  template <int dim>
  unsigned int
  Blocks<dim>::rank() const
  {
    return my_rank;
  }


  template <int dim>
  const GridIndex<dim> &
  Blocks<dim>::n_cells() const
  {
    return cells;
  }


  template <int dim>
  bool
  Blocks<dim>::periodic(const unsigned int axis) const
  {
    return is_periodic[axis];
  }


  template <int dim>
  const GridIndex<dim> &
  Blocks<dim>::n_blocks() const
  {
    return blocks;
  }


  template <int dim>
  int
  Blocks<dim>::first_cell(const unsigned int axis, const int block) const
  {
    return std::int64_t(block) * cells[axis] / blocks[axis];
  }


  template <int dim>
  int
  Blocks<dim>::block_of_cell(const unsigned int axis, const int cell) const
  {
    // The largest b with floor(b n / m) <= cell.
    return ((std::int64_t(cell) + 1) * blocks[axis] - 1) / cells[axis];
  }


  template <int dim>
  GridIndex<dim>
  Blocks<dim>::block_of_rank(const unsigned int rank) const
  {
    GridIndex<dim> block;
    unsigned int   rest = rank;
    for (unsigned int d = 0; d < dim; ++d)
      {
        block[d] = rest % blocks[d];
        rest /= blocks[d];
      }
    return block;
  }


  template <int dim>
  unsigned int
  Blocks<dim>::rank_of_block(const GridIndex<dim> &block) const
  {
    return IndexBox<dim>{{}, blocks}.position(block);
  }


  template <int dim>
  IndexBox<dim>
  Blocks<dim>::cells_of_rank(const unsigned int rank) const
  {
    const auto    block = block_of_rank(rank);
    IndexBox<dim> box;
    for (unsigned int d = 0; d < dim; ++d)
      {
        box.lower[d] = first_cell(d, block[d]);
        box.upper[d] = first_cell(d, block[d] + 1);
      }
    return box;
  }


  template class Blocks<2>;
  template class Blocks<3>;
} // namespace undine
