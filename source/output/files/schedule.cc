// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files/schedule.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    // Times closer than this fraction of an interval, or of themselves, are the same.
    constexpr double rounding = 1e-9;
  } // namespace


  bool
  is_output_time(const Clock &clock)
  {
    if (clock.step == 0 || clock.ended())
      return true;
    if (clock.landing_interval <= 0)
      return false;
    const double intervals = clock.time / clock.landing_interval;
    return std::abs(intervals - std::round(intervals)) < rounding * std::max(1., intervals);
  }


  bool
  has_passed(const Clock &clock, const double time)
  {
    return time <= clock.time * (1 + rounding);
  }
} // namespace undine
