// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/parallel/throw_together.h>
#include <undine/cutting/closure_defect.h>
#include <undine/cutting/component_finder.h>
#include <undine/cutting/cut_block.h>
#include <undine/cutting/cut_flags.h>
#include <undine/cutting/facet_splitter.h>
#include <undine/cutting/sampled_regions.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    constexpr double largest_coordinate = 1e100; // of which differences and quotients stay finite


    /// The keys of the cells that hold parts of the surface. @{
    std::vector<std::int64_t>
    keys_of_cut_cells(const SplitSurface<2> &split)
    {
      std::vector<std::int64_t> keys(split.chords_on.keys().size());
      for (std::size_t i = 0; i < keys.size(); ++i)
        keys[i] = split.chords_on.keys().key(i) / 2;
      return keys;
    }

    std::vector<std::int64_t>
    keys_of_cut_cells(const SplitSurface<3> &split)
    {
      std::vector<std::int64_t> keys(split.fragments_in.keys().size());
      for (std::size_t i = 0; i < keys.size(); ++i)
        keys[i] = split.fragments_in.keys().key(i);
      return keys;
    }
    /// @}


    template <int dim>
    void
    add_cell(CutCells<dim>            &cut,
             CutWorkspace<dim>        &work,
             ComponentFinder<dim>     &finder,
             const PlacedSurface<dim> &placed,
             const std::int64_t        key)
    {
      cut.cell_slots.add(key);
      cut.cells.push_back({cut.block.node(key),
                           static_cast<int>(cut.components.size()),
                           static_cast<int>(cut.fragments.size()),
                           0});
      unsigned int flags = finder.find(cut, work, placed);
      if (work.split.failures > 0)
        flags |= cut_splitting_failed;
      double defect = 0;
      if (!(flags & cut_needs_sampling))
        {
          defect = closure_defect(work, cut);
          if (defect > reported_closure)
            flags |= cut_closure;
          else if (flags == 0)
            cut.counts.closure = std::max(cut.counts.closure, defect);
        }
      work.closure_defects.push_back(defect);
      cut.cells.back().flags = flags;
      if (flags & cut_needs_sampling)
        sample_cell(cut, work);
    }


    /// A cached cell.
    template <int dim>
    void
    add_kept_cell(CutCells<dim> &cut, CutWorkspace<dim> &work, const std::int64_t key)
    {
      const double defect = work.cache.add_cell(cut, key);
      work.closure_defects.push_back(defect);
      cut.counts.closure = std::max(cut.counts.closure, defect);
    }


    template <int dim>
    void
    find_faces(CutCells<dim>            &cut,
               CutWorkspace<dim>        &work,
               const PlacedSurface<dim> &placed,
               const GridIndex<dim>     &cell)
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (const int end : {0, 1})
          find_face(cut, work, placed, axis, moved(cell, axis, end));
    }


    /// What makes positions unfit for splitting; empty if nothing.
    template <int dim>
    std::string
    find_wrong_position(const std::vector<dealii::Point<dim>> &positions)
    {
      for (const auto &position : positions)
        for (unsigned int d = 0; d < dim; ++d)
          if (!(std::abs(position[d]) < largest_coordinate))
            return "A position on the boundary of a body is not a number. Try a smaller time step.";
      return "";
    }


    /// All that follows once crossings have been summed up.
    template <int dim>
    void
    find_parts(CutCells<dim> &cut, CutWorkspace<dim> &work, const PlacedSurface<dim> &placed)
    {
      auto keys = keys_of_cut_cells(work.split);
      std::sort(keys.begin(), keys.end());
      work.cache.compare(cut, work.split, placed);
      for (const std::int64_t key : keys)
        if (work.cache.hold(key))
          work.cache.find_faces(cut, work, placed, key);
        else
          find_faces(cut, work, placed, cut.block.node(key));
      ComponentFinder<dim> finder;
      for (const std::int64_t key : keys)
        if (work.cache.hold(key))
          add_kept_cell(cut, work, key);
        else
          add_cell(cut, work, finder, placed, key);
      work.cache.remember(cut, work, placed);
      cut.counts.reordered_edges = work.grid_edges.n_reordered();
      drop_debris(cut);
      close_sampled_cells(cut);
    }
  } // namespace


  template <int dim>
  GridBlock<dim>
  block_of_rank(const MacGrid<dim> &grid)
  {
    std::array<std::vector<double>, dim> planes;
    for (unsigned int d = 0; d < dim; ++d)
      planes[d] = grid.planes(d);
    return GridBlock<dim>(
      std::make_shared<const GridPlanes<dim>>(planes), grid.cells()->owned(), 1);
  }


  template <int dim>
  void
  cut_block(CutCells<dim> &cut, CutWorkspace<dim> &work, const PlacedSurface<dim> &placed)
  {
    const auto wrong = find_wrong_position(placed.positions);
    if (!wrong.empty())
      throw SolveError(wrong);
    cut.clear();
    work.clear();
    split_surface(work.split, cut.windings, cut.block, placed.surface, placed.positions);
    cut.windings.accumulate(cut.block);
    find_parts(cut, work, placed);
  }


  template <int dim>
  void
  cut_block(CutCells<dim>            &cut,
            CutWorkspace<dim>        &work,
            const PlacedSurface<dim> &placed,
            const Blocks<dim>        &blocks)
  {
    throw_together(find_wrong_position(placed.positions), blocks.communicator());
    cut.clear();
    work.clear();
    split_surface(work.split, cut.windings, cut.block, placed.surface, placed.positions);
    cut.windings.accumulate(cut.block);
    cut.windings.add_lower_blocks(cut.block, blocks);
    find_parts(cut, work, placed);
  }


  // clang-format off
#define INSTANTIATE(dim)                                                                           \
  template GridBlock<dim> block_of_rank(const MacGrid<dim> &);                                     \
  template void cut_block(CutCells<dim> &, CutWorkspace<dim> &, const PlacedSurface<dim> &);       \
  template void cut_block(CutCells<dim> &, CutWorkspace<dim> &, const PlacedSurface<dim> &,        \
                          const Blocks<dim> &);
  // clang-format on
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
