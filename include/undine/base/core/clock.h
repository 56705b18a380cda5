// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_clock_h
#define undine_base_core_clock_h

#include <undine/base/core/step_limit.h>

#include <limits>

namespace undine
{
  /// Simulated time [s] and the number of accepted steps. Steps are shortened so that they land on
  /// the end and on multiples of `landing_interval`.
  struct Clock
  {
    double       time             = 0;                                        ///< [s]
    double       end_time         = 0;                                        ///< [s]
    unsigned int step             = 0;                                        ///< accepted so far
    unsigned int maximum_steps    = std::numeric_limits<unsigned int>::max(); ///< stop after these
    double       landing_interval = 0; ///< [s]; 0: only the end is landed on

    StepLimit limit; ///< of the next step, after some that had to be cut

    /// The last step was taken by implicit Euler in the place of stages: there are no rates with
    /// which these could go on.
    bool after_fallback = false;

    bool
    ended() const;

    /// Add an accepted step of length dt [s] and snap to a landing time closer than rounding.
    void
    advance(double dt);

    /// The length of the next step [s]: `dt` [s] if it fits more than twice into the time to the
    /// next landing; else that time or, if it is longer than `dt`, half of it.
    double
    land(double dt) const;

    /// The next landing time after now [s].
    double
    next_landing() const;
  };
} // namespace undine

#endif
