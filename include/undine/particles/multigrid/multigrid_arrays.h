// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_multigrid_multigrid_arrays_h
#define undine_particles_multigrid_multigrid_arrays_h

#include <undine/particles/multigrid/multigrid_build.h>
#include <undine/particles/multigrid/multigrid_gradients.h>

#include <vector>

namespace undine::particles
{
  /// The memory of a multigrid method over the cells of a grid, and the passes that build it.
  template <class Executor, int dim, class Real>
  class MultigridArrays
  {
  public:
    MultigridArrays(Executor &executor, const CellGrid<dim, Real> &cells, const int n)
      : executor(executor)
      , cells(cells)
      , n(n)
      , grids(make_grids(cells))
      , n_cells(count_cells(grids))
      , cell_of(executor, n)
      , places_in_cells(executor, n)
      , functions(executor, grids.front().n)
      , sums(executor, static_cast<std::size_t>(n) * StencilGrid<dim>::size)
      , marks(executor, n_cells + 1)
      , marks_before(executor, n_cells + 1)
      , active(executor, n_cells)
      , n_active(executor, grids.size())
    {
      auto &levels     = cycle.levels;
      levels.n         = 0;
      levels.begins[0] = 0;
      cycle.n_large    = 0;
      for (const auto &grid : grids)
        {
          cycle.n_large += grid.n > small ? 1 : 0;
          add_level(grid);
        }
      cycle.n_large = minimum(maximum(cycle.n_large, 1), levels.n - 1);
    }

    /// After the matrix has been assembled. `starts` are those of the cells.
    template <class Entry>
    void
    build(const Place<dim, Real>            *places,
          const int                         *is_unknown,
          const PressureMatrix<Real, Entry> &matrix,
          const Real                        *diagonal,
          const int                         *starts)
    {
      const auto &finest = cycle.levels.level[0].grid;
      executor.run(finest.n,
                   MarkActiveCells<dim, Real>{cycle.levels, starts, is_unknown, marks.data()});
      executor.exclusive_scan(n_cells + 1, marks.data(), marks_before.data());
      executor.for_each(
        n_cells, ListActiveCells<dim, Real>{cycle.levels, marks.data(), marks_before.data()});
      executor.template for_each_with_room<StencilGrid<dim>::size, Real>(
        n,
        SumRowByCells<dim, Real, Entry>{cells,
                                        finest,
                                        places,
                                        is_unknown,
                                        matrix,
                                        diagonal,
                                        cell_of.data(),
                                        places_in_cells.data(),
                                        sums.data()});
      executor.run(finest.n,
                   BuildLevels<dim, Real>{cycle.levels, starts, is_unknown, sums.data(), n});
    }

    /// Conjugate gradients with what build() has made of the same system.
    template <class Entry>
    void
    solve(const ConjugateGradients<Real, Entry, Real> &base, const int *starts) const
    {
      executor.run(n,
                   MultigridGradients<dim, Real, Entry>{base,
                                                        cycle,
                                                        {grids.front(), functions.data()},
                                                        cell_of.data(),
                                                        places_in_cells.data(),
                                                        starts});
    }

  private:
    static constexpr int small    = 256; ///< cells: not worth the waiting of all workers
    static constexpr int coarsest = 8;

    /// At least two.
    static std::vector<StencilGrid<dim>>
    make_grids(const CellGrid<dim, Real> &cells)
    {
      StencilGrid<dim> grid;
      for (int axis = 0; axis < dim; ++axis)
        {
          grid.cells[axis]    = cells.cells[axis];
          grid.strides[axis]  = cells.strides[axis];
          grid.periodic[axis] = cells.periodic[axis];
        }
      grid.n = cells.n_cells();
      std::vector<StencilGrid<dim>> result{grid, coarsened(grid)};
      while (result.back().n > coarsest && result.size() < MultigridLevels<dim, Real>::most)
        result.push_back(coarsened(result.back()));
      return result;
    }

    static int
    count_cells(const std::vector<StencilGrid<dim>> &grids)
    {
      int sum = 0;
      for (const auto &grid : grids)
        sum += grid.n;
      return sum;
    }

    void
    add_level(const StencilGrid<dim> &grid)
    {
      constexpr int     vectors = 4;
      const std::size_t rows    = grid.n;
      memory.emplace_back(executor, rows * (StencilGrid<dim>::size + vectors));
      Real *const matrix = memory.back().data();
      Real *const after  = matrix + rows * StencilGrid<dim>::size;
      auto       &levels = cycle.levels;
      const int   begin  = levels.begins[levels.n];

      levels.begins[levels.n + 1] = begin + grid.n;
      levels.level[levels.n]      = {grid,
                                     active.data() + begin,
                                     n_active.data() + levels.n,
                                     matrix,
                                     after,
                                     after + rows,
                                     after + 2 * rows,
                                     after + 3 * rows};
      ++levels.n;
    }

    Executor                                 &executor;
    CellGrid<dim, Real>                       cells;
    int                                       n; ///< particles
    std::vector<StencilGrid<dim>>             grids;
    int                                       n_cells; ///< of all levels
    Buffer<Executor, int>                     cell_of;
    Buffer<Executor, PlaceInCell<dim, Real>>  places_in_cells;
    Buffer<Executor, LinearInCell<dim, Real>> functions;
    Buffer<Executor, Real>                    sums; ///< of rows, by cells
    Buffer<Executor, int>                     marks, marks_before;
    Buffer<Executor, StencilCell<dim>>        active; ///< of all levels
    Buffer<Executor, int>                     n_active;
    std::vector<Buffer<Executor, Real>>       memory;
    MultigridCycle<dim, Real>                 cycle;
  };
} // namespace undine::particles

#endif
