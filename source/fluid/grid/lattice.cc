// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/lattice.h>

#include <limits>
#include <utility>

namespace undine
{
  template <int dim>
  Lattice<dim>::Lattice(std::shared_ptr<const Blocks<dim>> blocks,
                        const std::array<Row, dim>        &rows_,
                        const unsigned int                 normal_axis)
    : block_structure(std::move(blocks))
    , rows(rows_)
    , axis(normal_axis)
    , mine(owned(block_structure->rank()))
  {
    first_number.push_back(0);
    for (unsigned int rank = 0; rank < block_structure->n_ranks(); ++rank)
      first_number.push_back(first_number.back() + owned(rank).size());
  }


  template <int dim>
  GridIndex<dim>
  Lattice<dim>::shape() const
  {
    GridIndex<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = rows[d].size();
    return result;
  }


  template <int dim>
  dealii::types::global_dof_index
  Lattice<dim>::n_points() const
  {
    return first_number.back();
  }


  template <int dim>
  dealii::Point<dim>
  Lattice<dim>::point(const GridIndex<dim> &index) const
  {
    dealii::Point<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = rows[d].position(index[d]);
    return result;
  }


  template <int dim>
  IndexBox<dim>
  Lattice<dim>::owned(const unsigned int rank) const
  {
    auto box = block_structure->cells_of_rank(rank);
    for (unsigned int d = 0; d < dim; ++d)
      if (box.upper[d] == block_structure->n_cells()[d])
        box.upper[d] = rows[d].size();
    return box;
  }


  template <int dim>
  IndexBox<dim>
  Lattice<dim>::with_ghosts(const unsigned int rank, const GridIndex<dim> &width) const
  {
    auto box = owned(rank).grown(width);
    for (unsigned int d = 0; d < dim; ++d)
      if (!rows[d].periodic())
        {
          const int more = rows[d].has_boundary_points() ? 1 : 0;
          box.lower[d]   = std::max(box.lower[d], -more);
          box.upper[d]   = std::min(box.upper[d], rows[d].size() + more);
        }
    return box;
  }


  template <int dim>
  GridIndex<dim>
  Lattice<dim>::wrapped(GridIndex<dim> index) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      index[d] = rows[d].wrapped(index[d]);
    return index;
  }


  template <int dim>
  bool
  Lattice<dim>::is_boundary_point(const GridIndex<dim> &index) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (!rows[d].periodic() && (index[d] < 0 || index[d] >= rows[d].size()))
        return true;
    return false;
  }


  template <int dim>
  const GhostLayers<dim> &
  Lattice<dim>::ghost_layers(const GridIndex<dim> &stored, const GridIndex<dim> &width) const
  {
    const Widths widths{stored, width};
    const auto   known = ghost_layers_of_widths.find(widths);
    return known != ghost_layers_of_widths.end()
             ? known->second
             : ghost_layers_of_widths.try_emplace(widths, *this, stored, width).first->second;
  }


  template <int dim>
  dealii::types::global_dof_index
  Lattice<dim>::number(const GridIndex<dim> &index) const
  {
    const auto   point = wrapped(index);
    unsigned int rank  = block_structure->rank();
    if (mine.contains(point))
      return first_number[rank] + mine.position(point);
    GridIndex<dim> block;
    for (unsigned int d = 0; d < dim; ++d)
      block[d] =
        block_structure->block_of_cell(d, std::min(point[d], block_structure->n_cells()[d] - 1));
    rank = block_structure->rank_of_block(block);
    return first_number[rank] + owned(rank).position(point);
  }


  template <int dim>
  dealii::IndexSet
  Lattice<dim>::owned_numbers() const
  {
    const auto       rank = block_structure->rank();
    dealii::IndexSet set(n_points());
    set.add_range(first_number[rank], first_number[rank + 1]);
    return set;
  }


  template class Lattice<2>;
  template class Lattice<3>;
} // namespace undine
