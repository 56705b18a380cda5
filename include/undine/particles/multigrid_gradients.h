// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_multigrid_gradients_h
#define undine_particles_multigrid_gradients_h

#include <undine/particles/conjugate_gradients.h>
#include <undine/particles/multigrid.h>

namespace undine::particles
{
  /// Conjugate gradients as ConjugateGradients, preconditioned by Jacobi's method on the particles
  /// plus a multigrid cycle on the cells that particles are sorted by: u = D^{-1} r + c P V P^T r,
  /// where P gives particles the value of their cell. The number of iterations hardly grows with
  /// that of particles.
  template <int dim, class Real, class Entry>
  struct MultigridGradients
  {
    ConjugateGradients<Real, Entry, Real> base;
    MultigridCycle<dim, Real>             cycle;
    const int                            *cell_of; ///< of the particles; -1: no unknown
    const int                            *starts;  ///< of the cells

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      if (base.control->done())
        return;
      const int    n = base.system.matrix.n;
      const double size =
        team.template sum<1>(n, [&](const int i, Sums<1> &sums) { begin(i, sums); })[0];
      const double goal = base.bounds.tolerance * base.bounds.tolerance * size;
      double       last = 0, last_step = 0, square = 0;
      int          iteration = 0;
      for (;; ++iteration)
        {
          precondition(team);
          const auto now =
            team.template sum<3>(n, [&](const int i, Sums<3> &sums) { multiply(i, sums); });
          square = now[2];
          if (!(square > goal) || iteration == base.bounds.max_iterations)
            break;
          const double beta = iteration == 0 ? 0. : now[0] / last;
          const double step =
            now[0] / (iteration == 0 ? now[1] : now[1] - beta * now[0] / last_step);
          last      = now[0];
          last_step = step;
          team.for_each(
            n, [&](const int i) { update(i, static_cast<Real>(step), static_cast<Real>(beta)); });
          team.sync();
        }
      if (team.is_first())
        base.report(iteration, size > 0 ? sqrt(square / size) : 0.);
    }

  private:
    UNDINE_HOST_DEVICE
    void
    begin(const int i, Sums<1> &sums) const
    {
      const auto &system = base.system;
      const Real  b      = system.right_hand_side[i];
      sums[0] += static_cast<double>(b) * b / system.diagonal[i];
      base.vectors.r[i] = b - system.row_times(i, system.solution);
      base.vectors.p[i] = base.vectors.s[i] = 0;
    }

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    precondition(Team &team) const
    {
      const auto &finest = cycle.levels[0];
      const auto *r      = base.vectors.r;
      finest.for_each_active(team, [&](const int cell) {
        Real sum = 0;
        for (int i = starts[cell]; i < starts[cell + 1]; ++i)
          sum += r[i];
        cycle.begin(0, cell, sum);
      });
      team.sync();
      cycle(team);
      team.for_each(base.system.matrix.n, [&](const int i) {
        const int cell = cell_of[i];
        Real      u    = r[i] / base.system.diagonal[i];
        if (cell >= 0)
          u += cycle.factor * finest.x[cell];
        base.vectors.u[i] = u;
      });
      team.sync();
    }

    UNDINE_HOST_DEVICE
    void
    multiply(const int i, Sums<3> &sums) const
    {
      const auto  &system = base.system;
      const Real   w      = system.row_times(i, base.vectors.u);
      const double r = base.vectors.r[i], u = base.vectors.u[i];
      base.vectors.w[i] = w;
      sums[0] += r * u;
      sums[1] += w * u;
      sums[2] += static_cast<double>(base.vectors.r[i] / system.diagonal[i]) * r;
    }

    UNDINE_HOST_DEVICE
    void
    update(const int i, const Real alpha, const Real beta) const
    {
      const auto &v = base.vectors;
      const Real  p = v.u[i] + beta * v.p[i], s = v.w[i] + beta * v.s[i];
      v.p[i] = p;
      v.s[i] = s;
      base.system.solution[i] += alpha * p;
      v.r[i] -= alpha * s;
    }
  };
} // namespace undine::particles

#endif
