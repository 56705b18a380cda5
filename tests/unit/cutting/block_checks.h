// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_cutting_block_checks_h
#define undine_tests_cutting_block_checks_h

#include <undine/cutting/facet_splitter.h>

#include <cutting/trial.h>

namespace undine_tests
{
  /// What was compared with the whole, over all ranks, and how much of it differs in any bit.
  struct BlockComparison
  {
    int  n     = 0;
    long cells = 0, pieces = 0, windings = 0, differences = 0;

    void
    add(const BlockComparison &other)
    {
      n += other.n;
      cells += other.cells;
      pieces += other.pieces;
      windings += other.windings;
      differences += other.differences;
    }
  };


  /// A number for each component that does not depend on the block: cell and position in it.
  template <int dim>
  std::int64_t
  name_of(const CutCells<dim> &cut, const int component, const GridPlanes<dim> &grid)
  {
    if (component < 0)
      return component;
    const auto &cell = cut.cells[cut.components[component].cell];
    return static_cast<std::int64_t>(all_cells(grid).position(cell.index)) * 1000 + component -
           cell.first_component;
  }


  /// Whether a cell has the same components and fragments in a block and in the whole;
  /// `facets` are the numbers of the block's facets in the whole surface.
  template <int dim>
  bool
  same_cell(const CutCells<dim>             &block,
            const int                        a,
            const CutCells<dim>             &whole,
            const int                        b,
            const std::vector<unsigned int> &facets,
            const GridPlanes<dim>           &grid)
  {
    const auto &x = block.cells[a], &y = whole.cells[b];
    const int   n    = block.end_component(a) - x.first_component;
    const int   m    = block.end_fragment(a) - x.first_fragment;
    bool        same = x.flags == y.flags && n == whole.end_component(b) - y.first_component &&
                m == whole.end_fragment(b) - y.first_fragment;
    for (int i = 0; i < n && same; ++i)
      {
        const auto &c = block.components[x.first_component + i];
        const auto &d = whole.components[y.first_component + i];
        same          = c.volume == d.volume && c.centroid == d.centroid;
      }
    for (int i = 0; i < m && same; ++i)
      {
        const auto &c = block.fragments[x.first_fragment + i];
        const auto &d = whole.fragments[y.first_fragment + i];
        same = facets[c.facet] == d.facet && c.area_vector == d.area_vector && c.mean == d.mean &&
               c.products == d.products &&
               name_of(block, c.component, grid) == name_of(whole, d.component, grid);
      }
    return same;
  }


  template <int dim>
  BlockComparison
  compare(const CutCells<dim>             &block,
          const CutCells<dim>             &whole,
          const std::vector<unsigned int> &facets,
          const GridPlanes<dim>           &grid)
  {
    BlockComparison result;
    for_each(block.block.cells(), [&](const GridIndex<dim> &cell) {
      const int a = block.cut_cell(cell), b = whole.cut_cell(cell);
      ++result.windings;
      if (a < 0)
        result.differences += b >= 0 || block.in_solid(cell) != whole.in_solid(cell);
      else
        {
          ++result.cells;
          result.differences += b < 0 || !same_cell(block, a, whole, b, facets, grid);
        }
      if (a < 0 || !block.block.owned().contains(cell))
        return;
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (const int end : {0, 1})
          {
            const int f = block.cut_face(axis, moved(cell, axis, end));
            const int g = whole.cut_face(axis, moved(cell, axis, end));
            const int n = block.end_piece(f) - block.faces[f].first_piece;
            result.pieces += n;
            if (n != whole.end_piece(g) - whole.faces[g].first_piece)
              ++result.differences;
            else
              for (int i = 0; i < n; ++i)
                {
                  const auto &p    = block.pieces[block.faces[f].first_piece + i];
                  const auto &q    = whole.pieces[whole.faces[g].first_piece + i];
                  bool        same = p.area == q.area && p.centroid == q.centroid;
                  for (const int side : {0, 1})
                    same = same && name_of(block, p.components[side], grid) ==
                                     name_of(whole, q.components[side], grid);
                  result.differences += !same;
                }
          }
    });
    return result;
  }


  /// Cut one configuration as a whole on every rank, and in blocks with a halo of one cell where
  /// every rank is given only the facets that it needs. Collective.
  template <int dim>
  BlockComparison
  compare_blocks(const Kind<dim>    &kind,
                 const Grid          grid_kind,
                 const std::uint64_t seed,
                 const int           number,
                 const MPI_Comm      communicator)
  {
    Random     random(seed * 1000003 + number);
    auto       bodies    = kind.make(random).bodies;
    const auto stretched = make_planes(bodies, grid_kind, random);
    const auto surface   = bodies.surface();
    const auto whole     = cut_all<dim>(stretched.planes, surface, bodies.nodes);

    const auto        grid = std::make_shared<const GridPlanes<dim>>(stretched.planes);
    const Blocks<dim> blocks(communicator, all_cells(*grid).upper, {});
    CutCells<dim>     cut(GridBlock<dim>(grid, blocks.cells_of_rank(blocks.rank()), 1));
    const auto        facets = facets_near(cut.block, surface, bodies.nodes);

    std::vector<std::array<unsigned, dim>> near;
    std::vector<unsigned>                  body_of_facet;
    for (const unsigned int facet : facets)
      {
        near.push_back(surface.facets()[facet]);
        body_of_facet.push_back(surface.body(facet));
      }
    const Surface<dim> part(bodies.nodes.size(), near, body_of_facet, surface.body_names());
    CutWorkspace<dim>  work;
    cut_block(cut, work, {part, bodies.nodes}, blocks);

    BlockComparison result = compare(cut, whole, facets, *grid);
    for (long *count : {&result.cells, &result.pieces, &result.windings, &result.differences})
      *count = dealii::Utilities::MPI::sum(*count, communicator);
    result.n = 1;
    return result;
  }
} // namespace undine_tests

#endif
