// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_multigrid_arrays_h
#define undine_particles_multigrid_arrays_h

#include <undine/particles/multigrid_gradients.h>

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
      , cell_of(executor, n)
      , sums(executor, static_cast<std::size_t>(n) * StencilGrid<dim>::size)
      , flags(executor, cells.n_cells() + 1)
    {
      StencilGrid<dim> grid;
      for (int axis = 0; axis < dim; ++axis)
        {
          grid.cells[axis]    = cells.cells[axis];
          grid.strides[axis]  = cells.strides[axis];
          grid.periodic[axis] = cells.periodic[axis];
        }
      grid.n        = cells.n_cells();
      cycle.n_large = 0;
      for (cycle.n_levels = 0; cycle.n_levels < MultigridCycle<dim, Real>::most_levels;)
        {
          cycle.n_large += grid.n > small ? 1 : 0;
          add_level(grid);
          if (grid.n <= coarsest)
            break;
          grid = coarsened(grid);
        }
      cycle.n_large = minimum(cycle.n_large, cycle.n_levels - 1);
      cycle.damping = Real(0.95);
      cycle.factor  = Real(1.6);
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
      const auto &finest = cycle.levels[0];
      executor.for_each(
        n,
        SumRowByCells<dim, Real, Entry>{
          cells, finest.grid, places, is_unknown, matrix, diagonal, cell_of.data(), sums.data()});
      executor.for_each(finest.grid.n * StencilGrid<dim>::size,
                        SumRows<dim, Real>{finest, starts, cell_of.data(), sums.data(), n});
      for (int k = 0; k + 1 < cycle.n_levels; ++k)
        executor.for_each(cycle.levels[k + 1].grid.n,
                          CoarsenMatrix<dim, Real>{cycle.levels[k], cycle.levels[k + 1]});
      for (int k = 0; k < cycle.n_levels; ++k)
        if (cycle.levels[k].active != nullptr)
          list_active(cycle.levels[k]);
    }

    /// Conjugate gradients with what build() has made of the same system.
    template <class Entry>
    void
    solve(const ConjugateGradients<Real, Entry, Real> &base, const int *starts) const
    {
      executor.run(n, MultigridGradients<dim, Real, Entry>{base, cycle, cell_of.data(), starts});
    }

  private:
    static constexpr int small    = 2048; ///< cells: not worth the waiting of all workers
    static constexpr int coarsest = 64;

    void
    list_active(const MultigridLevel<dim, Real> &level)
    {
      executor.for_each(level.grid.n + 1, FlagActive<dim, Real>{level, flags.data()});
      executor.exclusive_scan(level.grid.n + 1, flags.data(), level.active_before);
      executor.for_each(level.grid.n, ListActive<dim, Real>{level});
    }

    void
    add_level(const StencilGrid<dim> &grid)
    {
      constexpr int vectors = 5;
      memory.emplace_back(executor,
                          static_cast<std::size_t>(grid.n) * (StencilGrid<dim>::size + vectors));
      Real *const matrix   = memory.back().data();
      Real *const after    = matrix + static_cast<std::size_t>(grid.n) * StencilGrid<dim>::size;
      const bool  is_large = grid.n > small;
      lists.emplace_back(executor, is_large ? 2 * static_cast<std::size_t>(grid.n) + 1 : 0);
      cycle.levels[cycle.n_levels++] = {grid,
                                        matrix,
                                        after,
                                        after + grid.n,
                                        after + 2 * static_cast<std::size_t>(grid.n),
                                        after + 3 * static_cast<std::size_t>(grid.n),
                                        after + 4 * static_cast<std::size_t>(grid.n),
                                        is_large ? lists.back().data() : nullptr,
                                        is_large ? lists.back().data() + grid.n : nullptr};
    }

    Executor                           &executor;
    CellGrid<dim, Real>                 cells;
    int                                 n;
    Buffer<Executor, int>               cell_of;
    Buffer<Executor, Real>              sums; ///< of rows, by cells
    Buffer<Executor, int>               flags;
    std::vector<Buffer<Executor, Real>> memory;
    std::vector<Buffer<Executor, int>>  lists; ///< of active cells
    MultigridCycle<dim, Real>           cycle;
  };
} // namespace undine::particles

#endif
