// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_multigrid_h
#define undine_particles_multigrid_h

#include <undine/particles/buffer.h>
#include <undine/particles/pressure_matrix.h>
#include <undine/particles/stencil_grid.h>

namespace undine::particles
{
  /// The pressure equation of one level, A x = r, with one unknown a cell.
  template <int dim, class Real>
  struct MultigridLevel
  {
    StencilGrid<dim> grid;
    Real            *matrix; ///< entry k of cell i at k n + i
    Real            *inverse_diagonal;
    Real            *r, *x;
    Real            *smooth; ///< omega D^{-1} r
    Real            *rest;   ///< r - A smooth

    /// Of large levels, many of whose cells may be empty: those that are not; nullptr: not listed.
    /// @{
    int *active;
    int *active_before; ///< how many before each cell; of all after the last
    /// @}

    UNDINE_HOST_DEVICE
    bool
    is_active(const int cell) const
    {
      return inverse_diagonal[cell] > 0;
    }

    template <class Team, class Function>
    UNDINE_HOST_DEVICE
    void
    for_each_active(Team &team, const Function &f) const
    {
      if (active != nullptr)
        team.for_each_spread(active_before[grid.n], [&](const int place) { f(active[place]); });
      else
        team.for_each_spread(grid.n, [&](const int cell) {
          if (is_active(cell))
            f(cell);
        });
    }
  };


  /// A particle's row of the matrix, summed over the particles of each cell around it.
  template <int dim, class Real, class Entry>
  struct SumRowByCells
  {
    CellGrid<dim, Real>         cells;
    StencilGrid<dim>            grid;
    const Place<dim, Real>     *places;
    const int                  *is_unknown;
    PressureMatrix<Real, Entry> matrix;
    const Real                 *diagonal;
    int                        *cell_of; ///< of the particle; -1: has no unknown
    Real                       *sums;    ///< entry k of particle i at k n + i

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      constexpr int size = StencilGrid<dim>::size;
      cell_of[i]         = is_unknown[i] ? cells.cell_of(places[i].x) : -1;
      if (!is_unknown[i])
        return;
      int here[dim];
      for (int axis = 0; axis < dim; ++axis)
        here[axis] = cells.coordinate(places[i].x, axis);
      Real row[size] = {};
      row[size / 2]  = diagonal[i];
      for (int k = 0; k < matrix.counts[i]; ++k)
        {
          const Entry entry = matrix.entries[list_slot(i, k, matrix.capacity)];
          const auto  x     = places[i + entry.difference()].x;
          int         where = 0;
          for (int axis = dim - 1; axis >= 0; --axis)
            where = 3 * where + 1 + grid.difference(cells.coordinate(x, axis), here[axis], axis);
          row[where] -= entry.coefficient(matrix.scale);
        }
      for (int k = 0; k < size; ++k)
        sums[static_cast<std::size_t>(k) * matrix.n + i] = row[k];
    }
  };


  /// The matrix of the finest level, from the sums of SumRowByCells.
  template <int dim, class Real>
  struct SumRows
  {
    MultigridLevel<dim, Real> level;
    const int                *starts; ///< of the cells
    const int                *cell_of;
    const Real               *sums;
    int                       n;

    UNDINE_HOST_DEVICE
    void
    operator()(const int place) const
    {
      const int entry = place / level.grid.n, cell = place % level.grid.n;
      Real      sum = 0;
      for (int i = starts[cell]; i < starts[cell + 1]; ++i)
        if (cell_of[i] >= 0)
          sum += sums[static_cast<std::size_t>(entry) * n + i];
      level.matrix[place] = sum;
      if (entry == StencilGrid<dim>::size / 2)
        level.inverse_diagonal[cell] = sum > Real(1e-6) ? 1 / sum : Real(0);
    }
  };


  /// 1 for each active cell. After the last follows 0.
  template <int dim, class Real>
  struct FlagActive
  {
    MultigridLevel<dim, Real> level;
    int                      *flags;

    UNDINE_HOST_DEVICE
    void
    operator()(const int cell) const
    {
      flags[cell] = cell < level.grid.n && level.is_active(cell) ? 1 : 0;
    }
  };


  /// Fills the list of active cells, after active_before.
  template <int dim, class Real>
  struct ListActive
  {
    MultigridLevel<dim, Real> level;

    UNDINE_HOST_DEVICE
    void
    operator()(const int cell) const
    {
      if (level.is_active(cell))
        level.active[level.active_before[cell]] = cell;
    }
  };


  /// The matrix of a coarser level, sums of the finer one's.
  template <int dim, class Real>
  struct CoarsenMatrix
  {
    MultigridLevel<dim, Real> fine, coarse;

    UNDINE_HOST_DEVICE
    void
    operator()(const int cell) const
    {
      constexpr int size      = StencilGrid<dim>::size;
      Real          row[size] = {};
      int           here[dim];
      for (int axis = 0; axis < dim; ++axis)
        here[axis] = coarse.grid.coordinate(cell, axis);
      for (int child = 0; child < (1 << dim); ++child)
        {
          int  index  = 0;
          bool exists = true;
          for (int axis = 0; axis < dim; ++axis)
            {
              const int c = 2 * here[axis] + (child >> axis & 1);
              exists      = exists && c < fine.grid.cells[axis];
              index += c * fine.grid.strides[axis];
            }
          if (!exists || !fine.is_active(index))
            continue;
          for (int entry = 0; entry < size; ++entry)
            {
              const Real value = fine.matrix[static_cast<std::size_t>(entry) * fine.grid.n + index];
              if (value != 0)
                row[entry_of(here, child, entry)] += value;
            }
        }
      for (int entry = 0; entry < size; ++entry)
        coarse.matrix[static_cast<std::size_t>(entry) * coarse.grid.n + cell] = row[entry];
      coarse.inverse_diagonal[cell] = row[size / 2] > Real(1e-6) ? 1 / row[size / 2] : Real(0);
    }

  private:
    /// To which entry of the coarse cell's stencil an entry of a child's belongs.
    UNDINE_HOST_DEVICE
    int
    entry_of(const int (&here)[dim], const int child, const int entry) const
    {
      int result = 0, factor = 1, rest = entry;
      for (int axis = 0; axis < dim; ++axis, rest /= 3, factor *= 3)
        {
          const int c     = 2 * here[axis] + (child >> axis & 1);
          const int other = fine.grid.next_to(c, rest % 3 - 1, axis) / 2;
          result += factor * (1 + coarse.grid.difference(other, here[axis], axis));
        }
      return result;
    }
  };


  /// One V-cycle over all levels, with one damped Jacobi step before and after each coarser level
  /// and `factor` times the coarser level's correction, which piecewise constant functions
  /// underestimate. Symmetric. Small levels are done by few workers, which saves waiting.
  template <int dim, class Real>
  struct MultigridCycle
  {
    static constexpr int most_levels = 12;

    MultigridLevel<dim, Real> levels[most_levels];
    int                       n_levels;
    int                       n_large; ///< levels done by all workers
    Real                      damping; ///< omega
    Real                      factor;

    /// From r of the finest level to its x.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      for (int k = 0; k < n_large; ++k)
        descend(team, k);
      team.alone([&](auto &few) {
        for (int k = n_large; k + 1 < n_levels; ++k)
          descend(few, k);
        solve_coarsest(few);
        for (int k = n_levels - 2; k >= n_large; --k)
          ascend(few, k);
      });
      team.sync();
      for (int k = n_large - 1; k >= 0; --k)
        ascend(team, k);
    }

    /// What the level k begins with.
    UNDINE_HOST_DEVICE
    void
    begin(const int k, const int cell, const Real residual) const
    {
      const auto &level  = levels[k];
      level.r[cell]      = residual;
      level.smooth[cell] = damping * level.inverse_diagonal[cell] * residual;
    }

  private:
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    descend(Team &team, const int k) const
    {
      const auto &fine = levels[k], &coarse = levels[k + 1];
      fine.for_each_active(team, [&](const int cell) {
        Real sum = 0;
        for_each_around(fine.grid, fine.grid, cell, [&](const int entry, const int j, const int) {
          sum += fine.matrix[static_cast<std::size_t>(entry) * fine.grid.n + cell] * fine.smooth[j];
        });
        fine.rest[cell] = fine.r[cell] - sum;
      });
      team.sync();
      coarse.for_each_active(
        team, [&](const int cell) { begin(k + 1, cell, sum_over_children(fine, coarse, cell)); });
      team.sync();
    }

    UNDINE_HOST_DEVICE
    static Real
    sum_over_children(const MultigridLevel<dim, Real> &fine,
                      const MultigridLevel<dim, Real> &coarse,
                      const int                        cell)
    {
      Real sum = 0;
      for (int child = 0; child < (1 << dim); ++child)
        {
          int  index  = 0;
          bool exists = true;
          for (int axis = 0; axis < dim; ++axis)
            {
              const int c = 2 * coarse.grid.coordinate(cell, axis) + (child >> axis & 1);
              exists      = exists && c < fine.grid.cells[axis];
              index += c * fine.grid.strides[axis];
            }
          if (exists && fine.is_active(index))
            sum += fine.rest[index];
        }
      return sum;
    }

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    solve_coarsest(Team &team) const
    {
      const auto &level = levels[n_levels - 1];
      Real       *now = level.smooth, *next = level.rest;
      for (int sweep = 0; sweep < 8; ++sweep)
        {
          team.for_each_spread(level.grid.n, [&](const int cell) {
            Real sum = 0;
            for_each_around(
              level.grid, level.grid, cell, [&](const int entry, const int j, const int) {
                sum += level.matrix[static_cast<std::size_t>(entry) * level.grid.n + cell] * now[j];
              });
            next[cell] = now[cell] + damping * level.inverse_diagonal[cell] * (level.r[cell] - sum);
          });
          team.sync();
          Real *const last = now;
          now              = next;
          next             = last;
        }
      team.for_each_spread(level.grid.n, [&](const int cell) { level.x[cell] = now[cell]; });
      team.sync();
    }

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    ascend(Team &team, const int k) const
    {
      const auto &fine = levels[k], &coarse = levels[k + 1];
      fine.for_each_active(team, [&](const int cell) {
        Real sum = 0, mine = 0;
        for_each_around(
          fine.grid, coarse.grid, cell, [&](const int entry, const int j, const int parent) {
            const Real y = fine.smooth[j] + factor * coarse.x[parent];
            sum += fine.matrix[static_cast<std::size_t>(entry) * fine.grid.n + cell] * y;
            if (entry == StencilGrid<dim>::size / 2)
              mine = y;
          });
        fine.x[cell] = mine + damping * fine.inverse_diagonal[cell] * (fine.r[cell] - sum);
      });
      team.sync();
    }
  };
} // namespace undine::particles

#endif
