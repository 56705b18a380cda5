// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_pressure_damped_iterations_h
#define undine_particles_pressure_damped_iterations_h

#include <undine/particles/pressure/conjugate_gradients.h>

namespace undine::particles
{
  /// Chebyshev's iteration for a system of ConjugateGradients, for a good guess and a coarse
  /// tolerance: it damps what is in the range of eigenvalues of D^{-1} A from `lowest` to `highest`
  /// and needs no products of vectors for it, so that an iteration is one pass over the matrix.
  /// Where that does not suffice, conjugate gradients finish. No eigenvalue is larger than two.
  template <class Real, class Entry, class Value>
  struct DampedIterations
  {
    static constexpr Real lowest = Real(0.2), highest = Real(2);
    static constexpr int  most = 12; ///< iterations

    ConjugateGradients<Real, Entry, Value> base;

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      if (base.control->done())
        return;
      constexpr Real middle = (highest + lowest) / 2, half = (highest - lowest) / 2;
      const int      n   = base.system.matrix.n;
      Stored        *now = base.system.solution, *next = base.vectors.u;
      Real           rho       = 0;
      int            iteration = 0;
      Sums<2>        sizes;
      for (;; ++iteration)
        {
          const bool is_first = iteration == 0;
          const Real last     = rho;
          rho                 = is_first ? half / middle : 1 / (2 * middle / half - last);
          const Real step     = is_first ? 1 / middle : 2 * rho / half;
          const Real memory   = is_first ? Real(0) : rho * last;
          sizes               = team.template sum<2>(
            n, [&](const int i, Sums<2> &sums) { iterate(i, now, next, step, memory, sums); });
          if (has_converged(sizes) || iteration == most)
            break;
          Stored *const other = now;
          now                 = next;
          next                = other;
        }
      // The solution is what was measured, or one iteration more.
      if (!has_converged(sizes))
        base(team);
      else if (team.is_first())
        base.report(iteration, sizes[1] > 0 ? sqrt(sizes[0] / sizes[1]) : 0.);
    }

  private:
    using Stored = typename Components<Value>::Stored;

    UNDINE_HOST_DEVICE
    bool
    has_converged(const Sums<2> &sizes) const
    {
      return !(sizes[0] > base.bounds.tolerance * base.bounds.tolerance * sizes[1]);
    }

    /// Adds to the sizes of the residual of `now` and of the right-hand side.
    UNDINE_HOST_DEVICE
    void
    iterate(const int     i,
            const Stored *now,
            Stored       *next,
            const Real    step,
            const Real    memory,
            Sums<2>      &sums) const
    {
      const Real inverse = 1 / base.system.diagonal[i];
      Value      b = base.system.right_hand_side[i], r = base.system.row_times(i, now);
      Value      change = base.vectors.p[i], x = now[i];
      for (int k = 0; k < Components<Value>::count; ++k)
        {
          Real      &r_k = Components<Value>::of(r, k), &b_k = Components<Value>::of(b, k);
          Real      &change_k = Components<Value>::of(change, k);
          const Real rest     = b_k - r_k;
          sums[0] += static_cast<double>(rest) * rest * inverse;
          sums[1] += static_cast<double>(b_k) * b_k * inverse;
          change_k =
            memory != 0 ? memory * change_k + step * inverse * rest : step * inverse * rest;
          Components<Value>::of(x, k) += change_k;
        }
      base.vectors.p[i] = change;
      next[i]           = x;
    }
  };
} // namespace undine::particles

#endif
