// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/grid_block.h>

namespace undine
{
  template <int dim>
  GridBlock<dim>::GridBlock(std::shared_ptr<const GridPlanes<dim>> planes,
                            const IndexBox<dim>                   &owned,
                            const int                              halo)
    : grid_planes(planes)
    , owned_cells(owned)
  {
    IndexBox<dim> whole;
    for (unsigned int d = 0; d < dim; ++d)
      whole.upper[d] = grid_planes->n_cells(d);
    all_cells = owned.grown(all_directions<dim>(halo)).intersection(whole);
    all_nodes = all_cells;
    for (int &end : all_nodes.upper.values)
      ++end;
  }


  template <int dim>
  double
  GridBlock<dim>::cell_volume(const GridIndex<dim> &cell) const
  {
    double volume = 1;
    for (unsigned int d = 0; d < dim; ++d)
      volume *= grid_planes->width(d, cell[d]);
    return volume;
  }


  template <int dim>
  double
  GridBlock<dim>::face_area(const unsigned int axis, const GridIndex<dim> &face) const
  {
    double area = 1;
    for (unsigned int d = 0; d < dim; ++d)
      if (d != axis)
        area *= grid_planes->width(d, face[d]);
    return area;
  }


  template <int dim>
  double
  GridBlock<dim>::rounding(const GridIndex<dim> &cell) const
  {
    double level = 0;
    for (unsigned int d = 0; d < dim; ++d)
      level = std::max(level, grid_planes->rounding(d, cell[d]));
    return level;
  }


  template class GridBlock<2>;
  template class GridBlock<3>;
} // namespace undine
