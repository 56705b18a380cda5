// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_multigrid_multigrid_h
#define undine_particles_multigrid_multigrid_h

#include <undine/particles/execution/lanes.h>
#include <undine/particles/multigrid/stencil_grid.h>

#include <type_traits>

namespace undine::particles
{
  /// The pressure equation of one level, A x = r, with one unknown a cell.
  template <int dim, class Real>
  struct MultigridLevel
  {
    StencilGrid<dim>  grid;
    StencilCell<dim> *active; ///< the cells that have unknowns
    int              *n_active;
    Real             *matrix; ///< entry k of cell i at k n + i
    Real             *inverse_diagonal;
    Real             *r, *x;
    Real             *smooth; ///< omega D^{-1} r

    UNDINE_HOST_DEVICE
    Real
    entry(const int k, const int index) const
    {
      return matrix[static_cast<std::size_t>(k) * grid.n + index];
    }
  };


  /// The levels of a multigrid method, from the finest one on.
  template <int dim, class Real>
  struct MultigridLevels
  {
    static constexpr int most = 16;

    int                       n;
    MultigridLevel<dim, Real> level[most];
    int                       begins[most + 1]; ///< of their cells among those of all levels

    /// How many cells with unknowns they have, by value: everything else waits for that.
    struct Counts
    {
      int of[most];
    };

    UNDINE_HOST_DEVICE
    Counts
    counts() const
    {
      Counts result;
      for (int k = 0; k < n; ++k)
        result.of[k] = *level[k].n_active;
      return result;
    }
  };


  /// One V-cycle over all levels, with one Jacobi step before and after each coarser level and
  /// twice the coarser level's correction: sums over two cells a direction are twice as stiff as
  /// the Laplacian on a grid twice as coarse. Symmetric, without negative eigenvalues as long as
  /// rows are diagonally dominant: then 2 D^{-1} - D^{-1} A D^{-1} has none. Small levels are done
  /// by few workers, which saves waiting.
  ///
  /// The finest level's part is in pieces: what is before and after a piece can be done by those
  /// who did the same cells, without waiting for others.
  template <int dim, class Real>
  struct MultigridCycle
  {
    using Counts = typename MultigridLevels<dim, Real>::Counts;

    static constexpr int factor = 2; ///< of corrections

    MultigridLevels<dim, Real> levels;
    int                        n_large; ///< levels done by all workers, at least one

    /// What the level k begins with.
    UNDINE_HOST_DEVICE
    void
    begin(const int k, const int index, const Real residual) const
    {
      const auto &level   = levels.level[k];
      level.r[index]      = residual;
      level.smooth[index] = level.inverse_diagonal[index] * residual;
    }

    /// From what the finest level began with to x of the next one.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    correct(Team &team, const Counts &counts) const
    {
      for (int k = 0; k < n_large; ++k)
        descend(team, counts, k);
      team.alone([&](auto &few) {
        for (int k = n_large; k + 1 < levels.n; ++k)
          descend(few, counts, k);
        solve_coarsest(few, counts);
        for (int k = levels.n - 2; k >= n_large; --k)
          ascend(few, counts, k);
      });
      team.sync();
      for (int k = n_large - 1; k > 0; --k)
        ascend(team, counts, k);
    }

    /// Level k's x in a cell, for the first of the lanes.
    template <class Lanes>
    UNDINE_HOST_DEVICE
    Real
    finish(const int k, const StencilCell<dim> &cell, const Lanes &lanes) const
    {
      const auto &fine = levels.level[k], &coarse = levels.level[k + 1];
      const int   index = cell.index(fine.grid);
      Real        sum   = 0;
      for_each_around(
        fine.grid, coarse.grid, cell, lanes, [&](const int entry, const int j, const int parent) {
          sum += fine.entry(entry, index) * (fine.smooth[j] + factor * coarse.x[parent]);
        });
      const Real mine = fine.smooth[index] + factor * coarse.x[cell.parent(coarse.grid)];
      return mine + fine.inverse_diagonal[index] * (fine.r[index] - lanes.sum(sum));
    }

  private:
    /// The residual of `smooth`, summed over the children of each cell: a lane for each child.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    descend(Team &team, const Counts &counts, const int k) const
    {
      const auto &fine = levels.level[k], &coarse = levels.level[k + 1];
      const auto *cells = coarse.active;
      team.for_each_by_lanes(counts.of[k + 1], [&](const int c, const auto &lanes) {
        const StencilCell<dim> cell = cells[c];
        Real                   sum  = 0;
        UNDINE_UNROLL
        for (int first = 0; first < (1 << dim); first += std::decay_t<decltype(lanes)>::count())
          if (cell.children >> (first + lanes.rank()) & 1)
            sum += residual(fine, cell.child(first + lanes.rank()));
        sum = lanes.sum(sum);
        if (lanes.rank() == 0)
          begin(k + 1, cell.index(coarse.grid), sum);
      });
      team.sync();
    }

    UNDINE_HOST_DEVICE
    static Real
    residual(const MultigridLevel<dim, Real> &level, const StencilCell<dim> &cell)
    {
      const int index = cell.index(level.grid);
      Real      sum   = 0;
      for_each_around(
        level.grid, level.grid, cell, OneLane(), [&](const int entry, const int j, const int) {
          sum += level.entry(entry, index) * level.smooth[j];
        });
      return level.r[index] - sum;
    }

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    ascend(Team &team, const Counts &counts, const int k) const
    {
      const auto &level = levels.level[k];
      const auto *cells = level.active;
      team.for_each_by_lanes(counts.of[k], [&](const int c, const auto &lanes) {
        const Real x = finish(k, cells[c], lanes);
        if (lanes.rank() == 0)
          level.x[cells[c].index(level.grid)] = x;
      });
      team.sync();
    }

    /// By two Jacobi steps: it has few cells.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    solve_coarsest(Team &team, const Counts &counts) const
    {
      const auto &level = levels.level[levels.n - 1];
      const auto *cells = level.active;
      team.for_each_by_lanes(counts.of[levels.n - 1], [&](const int c, const auto &lanes) {
        const int index = cells[c].index(level.grid);
        Real      sum   = 0;
        for_each_around(
          level.grid, level.grid, cells[c], lanes, [&](const int entry, const int j, const int) {
            sum += level.entry(entry, index) * level.smooth[j];
          });
        sum = level.r[index] - lanes.sum(sum);
        if (lanes.rank() == 0)
          level.x[index] = level.smooth[index] + level.inverse_diagonal[index] * sum;
      });
      team.sync();
    }
  };
} // namespace undine::particles

#endif
