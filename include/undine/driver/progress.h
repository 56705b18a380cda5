// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_progress_h
#define undine_driver_progress_h

#include <undine/base/core/clock.h>
#include <undine/coupled/state/report.h>
#include <undine/driver/log.h>

#include <chrono>
#include <string>

namespace undine
{
  /// One line per step at most every half second (and for the first and the last step): step, time,
  /// step length, iterations, share done, wall time left.
  class Progress
  {
  public:
    /// `start` is the clock before the first step. The log must outlive it.
    Progress(Log &log, const Clock &start);

    /// A step has been made; prints a line if it is time.
    void
    report(const Clock &clock, const Report &report);

    /// A line on a step that takes long: after five seconds, then at pauses that double up to a
    /// minute.
    void
    within_step(const std::string &how_far);

  private:
    using Moment = std::chrono::steady_clock::time_point;

    double
    share_done(const Clock &clock) const;

    Log   &log;
    Clock  start;
    Moment begin;
    Moment last_line;
    Moment last_step;
    double pause_within = 0; ///< [s]
  };
} // namespace undine

#endif
