// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_pressure_conjugate_gradients_h
#define undine_particles_pressure_conjugate_gradients_h

#include <undine/particles/execution/sums.h>
#include <undine/particles/model/step_control.h>
#include <undine/particles/pressure/pressure_matrix.h>

namespace undine::particles
{
  /// When to stop.
  struct SolverBounds
  {
    double tolerance      = 1e-4; ///< of |r| / |b| in the norm of D^{-1}
    int    max_iterations = 2000;
  };

  /// The numbers in an unknown: one, or the components of a vector. @{
  template <class Real>
  struct Components
  {
    using Stored = Real; ///< in memory

    static constexpr int count = 1;

    UNDINE_HOST_DEVICE
    static Real &
    of(Real &value, const int)
    {
      return value;
    }
  };

  template <int dim, class Real>
  struct Components<Vector<dim, Real>>
  {
    using Stored = StoredVector<dim, Real>;

    static constexpr int count = dim;

    UNDINE_HOST_DEVICE
    static Real &
    of(Vector<dim, Real> &value, const int k)
    {
      return value[k];
    }
  };
  /// @}


  /// A system with the pressure matrix and a diagonal of its own: (D - K) x = b.
  template <class Real, class Entry, class Value>
  struct LinearSystem
  {
    using Stored = typename Components<Value>::Stored;

    PressureMatrix<Real, Entry> matrix;
    const Real                 *diagonal;
    const Stored               *right_hand_side;
    Stored                     *solution; ///< first the guess

    /// Rows that may not hang together with any known value, as those of a body that flies: they
    /// have identities below. A preconditioner must not spread anything to them that A does not
    /// feel; nullptr: there are none.
    const int *identities = nullptr;
    int        n_loose    = 0;

    UNDINE_HOST_DEVICE
    bool
    is_loose(const int i) const
    {
      return identities != nullptr && identities[i] < n_loose;
    }

    UNDINE_HOST_DEVICE
    Value
    row_times(const int i, const Stored *x) const
    {
      return diagonal[i] * Value(x[i]) - matrix.template row_times<Value>(i, x);
    }
  };

  /// Arrays that a solver needs, one entry a row.
  template <class Value>
  struct SolverVectors
  {
    typename Components<Value>::Stored *r, *u, *w, *p, *s;
  };


  /// Conjugate gradients with Jacobi's preconditioner in the form of Chronopoulos and Gear [1989]:
  /// two waits for all workers in an iteration. The components of vectors are systems of their own,
  /// solved together. One launch: convergence is decided where it runs.
  template <class Real, class Entry, class Value>
  struct ConjugateGradients
  {
    LinearSystem<Real, Entry, Value> system;
    SolverVectors<Value>             vectors;
    SolverBounds                     bounds;
    StepControl                     *control;
    SolverRecord StepControl::*record; ///< where to report

    static constexpr int count = Components<Value>::count;
    using Products             = Sums<2 * count>;

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      if (control->done())
        return;
      const int      n = system.matrix.n;
      const Products size =
        team.template sum<2 * count>(n, [&](const int i, Products &sums) { begin(i, sums); });
      Products last;
      double   last_step[count], alpha[count], beta[count];
      double   square    = 0;
      int      iteration = 0;
      for (;; ++iteration)
        {
          const Products now = team.template sum<2 * count>(
            n, [&](const int i, Products &sums) { multiply(i, sums); });
          square = total(now);
          if (!(square > bounds.tolerance * bounds.tolerance * total(size)) ||
              iteration == bounds.max_iterations)
            break;
          for (int k = 0; k < count; ++k)
            {
              beta[k] = iteration == 0 ? 0. : quotient(now[k], last[k]);
              const double curvature =
                iteration == 0 ? now[count + k]
                               : now[count + k] - beta[k] * quotient(now[k], last_step[k]);
              alpha[k] = last_step[k] = quotient(now[k], curvature);
            }
          last = now;
          team.for_each(n, [&](const int i) { update(i, alpha, beta); });
          team.sync();
        }
      if (team.is_first())
        report(iteration, total(size) > 0 ? sqrt(square / total(size)) : 0.);
    }

    /// Adds a solve to the record; by one worker.
    UNDINE_HOST_DEVICE
    void
    report(const int iterations, const double residual) const
    {
      SolverRecord &result = control->*record;
      result.iterations += iterations;
      result.most_iterations =
        maximum(result.most_iterations, static_cast<unsigned int>(iterations));
      result.worst_residual = maximum(result.worst_residual, residual);
      if (!(residual <= bounds.tolerance))
        ++result.not_converged;
    }

  private:
    using Part = Components<Value>;

    UNDINE_HOST_DEVICE
    static double
    quotient(const double a, const double b)
    {
      return b == 0 ? 0 : a / b;
    }

    UNDINE_HOST_DEVICE
    static double
    total(const Products &products)
    {
      double sum = 0;
      for (int k = 0; k < count; ++k)
        sum += products[k];
      return sum;
    }

    UNDINE_HOST_DEVICE
    void
    begin(const int i, Products &sums) const
    {
      const Real inverse = 1 / system.diagonal[i];
      Value      b       = system.right_hand_side[i];
      for (int k = 0; k < count; ++k)
        sums[k] += static_cast<double>(Part::of(b, k)) * Part::of(b, k) * inverse;
      b -= system.row_times(i, system.solution);
      vectors.r[i] = b;
      vectors.u[i] = inverse * b;
      vectors.p[i] = vectors.s[i] = Value();
    }

    UNDINE_HOST_DEVICE
    void
    multiply(const int i, Products &sums) const
    {
      Value r = vectors.r[i], u = vectors.u[i], w = system.row_times(i, vectors.u);
      vectors.w[i] = w;
      for (int k = 0; k < count; ++k)
        {
          sums[k] += static_cast<double>(Part::of(r, k)) * Part::of(u, k);
          sums[count + k] += static_cast<double>(Part::of(w, k)) * Part::of(u, k);
        }
    }

    UNDINE_HOST_DEVICE
    void
    update(const int i, const double *alpha, const double *beta) const
    {
      Value p = vectors.p[i], s = vectors.s[i], u = vectors.u[i], w = vectors.w[i],
            r = vectors.r[i], x = system.solution[i];
      for (int k = 0; k < count; ++k)
        {
          const Real a = static_cast<Real>(alpha[k]), b = static_cast<Real>(beta[k]);
          Part::of(p, k) = Part::of(u, k) + b * Part::of(p, k);
          Part::of(s, k) = Part::of(w, k) + b * Part::of(s, k);
          Part::of(x, k) += a * Part::of(p, k);
          Part::of(r, k) -= a * Part::of(s, k);
        }
      vectors.p[i]       = p;
      vectors.s[i]       = s;
      vectors.r[i]       = r;
      vectors.u[i]       = (1 / system.diagonal[i]) * r;
      system.solution[i] = x;
    }
  };
} // namespace undine::particles

#endif
