// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_multigrid_multigrid_gradients_h
#define undine_particles_multigrid_multigrid_gradients_h

#include <undine/particles/execution/share.h>
#include <undine/particles/multigrid/cell_interpolation.h>
#include <undine/particles/multigrid/multigrid.h>
#include <undine/particles/pressure/conjugate_gradients.h>

namespace undine::particles
{
  /// Conjugate gradients as ConjugateGradients, preconditioned by Jacobi's method on the particles
  /// plus a multigrid cycle on the cells that particles are sorted by: u = D^{-1} r + P V P^T r,
  /// where P interpolates between cells. The number of iterations hardly grows with
  /// that of particles.
  template <int dim, class Real, class Entry>
  struct MultigridGradients
  {
    ConjugateGradients<Real, Entry, Real> base;
    MultigridCycle<dim, Real>             cycle;
    CellInterpolation<dim, Real>          interpolation;
    const int                            *cell_of; ///< of the particles; -1: no unknown
    const PlaceInCell<dim, Real>         *places_in_cells;
    const int                            *starts; ///< of the cells

    using Counts = typename MultigridLevels<dim, Real>::Counts;

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      if (base.control->done())
        return;
      const int     n      = base.system.matrix.n;
      const Counts  counts = cycle.levels.counts();
      const Sums<2> sizes =
        team.template sum<2>(n, [&](const int i, Sums<2> &sums) { begin(i, sums); });
      const double goal   = base.bounds.tolerance * base.bounds.tolerance * sizes[0];
      double       square = sizes[1];
      double       last = 0, last_step = 0;
      int          iteration = 0;
      if (square > goal)
        {
          sum_residuals(team, counts);
          team.sync();
        }
      while (square > goal && iteration < base.bounds.max_iterations)
        {
          restrict_sums(team, counts);
          precondition(team, counts);
          const Sums<2> now =
            team.template sum<2>(n, [&](const int i, Sums<2> &sums) { multiply(i, sums); });
          const double beta = iteration == 0 ? 0. : now[0] / last;
          const double step =
            now[0] / (iteration == 0 ? now[1] : now[1] - beta * now[0] / last_step);
          last      = now[0];
          last_step = step;
          ++iteration;
          const Sums<1> mine =
            update(team, counts, static_cast<Real>(step), static_cast<Real>(beta));
          sum_residuals(team, counts);
          square = team.total(mine)[0];
        }
      if (team.is_first())
        base.report(iteration, sizes[0] > 0 ? sqrt(square / sizes[0]) : 0.);
    }

  private:
    /// Adds the squares of the right-hand side and of the first residual, in the norm of D^{-1}.
    UNDINE_HOST_DEVICE
    void
    begin(const int i, Sums<2> &sums) const
    {
      const auto &system = base.system;
      const Real  b      = system.right_hand_side[i];
      const Real  r      = b - system.row_times(i, system.solution);
      sums[0] += static_cast<double>(b) * b / system.diagonal[i];
      sums[1] += static_cast<double>(r) * r / system.diagonal[i];
      base.vectors.r[i] = r;
      base.vectors.p[i] = base.vectors.s[i] = base.vectors.u[i] = 0;
    }

    /// This worker's cells of the finest level. Passes that need from others only what is in these
    /// cells follow each other without waiting for all.
    template <class Team>
    UNDINE_HOST_DEVICE
    Share
    own_cells(const Team &team, const Counts &counts) const
    {
      return team.share(counts.of[0]);
    }

    /// The particles in them; between cells, some that have no unknown, too.
    UNDINE_HOST_DEVICE
    Share
    particles(const Share &own) const
    {
      if (own.begin >= own.end)
        return {0, 0};
      const auto *cells = finest().active;
      return {starts[cells[own.begin].index(finest().grid)],
              starts[cells[own.end - 1].index(finest().grid) + 1]};
    }

    UNDINE_HOST_DEVICE
    const MultigridLevel<dim, Real> &
    finest() const
    {
      return cycle.levels.level[0];
    }

    /// In each cell; others may read that after a wait for all.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    sum_residuals(const Team &team, const Counts &counts) const
    {
      const auto *cells = finest().active;
      struct Cell
      {
        int index, begin, end;
      };
      team.for_each_of(
        own_cells(team, counts),
        [&](const int c) {
          const int index = cells[c].index(finest().grid);
          return Cell{index, starts[index], starts[index + 1]};
        },
        [&](const int, const Cell &cell) {
          interpolation.functions[cell.index] = sums_of_residuals(cell.begin, cell.end);
        });
    }

    /// What the finest level begins with.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    restrict_sums(Team &team, const Counts &counts) const
    {
      const auto *cells = finest().active;
      team.for_each_of(own_cells(team, counts), [&](const int c) {
        const int index = cells[c].index(finest().grid);
        cycle.begin(0, index, interpolation.number(cells[c], index));
      });
      team.sync();
    }

    /// Of particles that follow each other in a cell.
    UNDINE_HOST_DEVICE
    LinearInCell<dim, Real>
    sums_of_residuals(const int begin, const int end) const
    {
      constexpr int together = 6; // on the way at the same time
      auto          result   = LinearInCell<dim, Real>::zero();
      for (int first = begin; first < end; first += together)
        {
          Real                   r[together];
          PlaceInCell<dim, Real> place[together];
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            {
              const int i = minimum(first + k, end - 1);
              r[k]        = first + k < end ? base.vectors.r[i] : Real(0);
              place[k]    = places_in_cells[i];
            }
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            result.add(r[k], place[k]);
        }
      return result;
    }

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    precondition(Team &team, const Counts &counts) const
    {
      cycle.correct(team, counts);
      const auto *cells = finest().active;
      const Share own   = own_cells(team, counts);
      team.for_each_of(own, [&](const int c) {
        finest().x[cells[c].index(finest().grid)] = cycle.finish(0, cells[c], OneLane());
      });
      team.sync();
      team.for_each_of(own, [&](const int c) {
        const int index                = cells[c].index(finest().grid);
        interpolation.functions[index] = interpolation.function(cells[c], index, finest().x);
      });
      team.sync_own();
      struct Row
      {
        Real r, d, correction;
      };
      team.for_each_of(
        particles(own),
        [&](const int i) {
          const int cell = cell_of[i];
          return Row{base.vectors.r[i],
                     base.system.diagonal[i],
                     cell >= 0 ? interpolation.functions[cell].at(places_in_cells[i]) : Real(0)};
        },
        [&](const int i, const Row &row) { base.vectors.u[i] = row.r / row.d + row.correction; });
      team.sync();
    }

    UNDINE_HOST_DEVICE
    void
    multiply(const int i, Sums<2> &sums) const
    {
      const Real   w = base.system.row_times(i, base.vectors.u);
      const double r = base.vectors.r[i], u = base.vectors.u[i];
      base.vectors.w[i] = w;
      sums[0] += r * u;
      sums[1] += w * u;
    }

    /// This worker's part of the new residual's square in the norm of D^{-1}, on the device a
    /// thread's.
    template <class Team>
    UNDINE_HOST_DEVICE
    Sums<1>
    update(Team &team, const Counts &counts, const Real alpha, const Real beta) const
    {
      const auto &v = base.vectors;
      Real *const x = base.system.solution;
      Sums<1>     square;
      struct Row
      {
        Real u, w, p, s, x, r, d;
      };
      team.for_each_of(
        particles(own_cells(team, counts)),
        [&](const int i) {
          return Row{v.u[i], v.w[i], v.p[i], v.s[i], x[i], v.r[i], base.system.diagonal[i]};
        },
        [&](const int i, const Row &row) {
          const Real p = row.u + beta * row.p, s = row.w + beta * row.s, r = row.r - alpha * s;
          v.p[i] = p;
          v.s[i] = s;
          x[i]   = row.x + alpha * p;
          v.r[i] = r;
          square[0] += static_cast<double>(r / row.d) * r;
        });
      team.sync_own();
      return square;
    }
  };
} // namespace undine::particles

#endif
