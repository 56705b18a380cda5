// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_explicit_steps_h
#define undine_particles_elasticity_explicit_steps_h

#include <undine/particles/model/step_control.h>

namespace undine::particles
{
  /// The explicit steps of elastic bodies in a sub-step: each is chosen when it begins, of equal
  /// ones for what is left.
  struct ExplicitSteps
  {
    double left;         ///< [s]
    double rate_at_rest; ///< as in StepBounds [1/s]
    double share;        ///< of 1 over the rate, for a step [1]
    int    most = 0;     ///< more are a failure

    int  taken   = 0;
    bool goes_on = true;
    bool failed  = false;

    UNDINE_HOST_DEVICE
    ExplicitSteps(const double time, const StepBounds &bounds)
      : left(time)
      , rate_at_rest(bounds.elastic_rate)
      , share(bounds.elastic_share)
    {
      most = 100 * number(0);
    }

    /// How many equal ones the rest would take at a rate [1/s].
    UNDINE_HOST_DEVICE
    int
    number(const double rate) const
    {
      const double steps = ceil(left * maximum(rate_at_rest, rate) / share);
      return static_cast<int>(minimum(maximum(steps, 1.), 1e5));
    }

    /// Length of the next one [s], at the rate that was measured at its beginning.
    UNDINE_HOST_DEVICE
    double
    next(const double rate)
    {
      const int    rest = number(rate);
      const double h    = left / rest;
      left -= h;
      ++taken;
      failed  = rest > 1 && taken > most;
      goes_on = rest > 1 && !failed;
      return h;
    }
  };
} // namespace undine::particles

#endif
