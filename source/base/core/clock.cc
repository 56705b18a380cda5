// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/clock.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    // Times closer than this fraction of the interval at hand are the same time.
    constexpr double rounding = 1e-9;
  } // namespace


  bool
  Clock::ended() const
  {
    return step >= maximum_steps || time >= end_time * (1 - 1e-12);
  }


  double
  Clock::next_landing() const
  {
    if (landing_interval <= 0)
      return end_time;
    const double passed = std::floor(time / landing_interval + rounding);
    return std::min((passed + 1) * landing_interval, end_time);
  }


  double
  Clock::land(const double dt) const
  {
    const double distance = next_landing() - time;
    const double parts    = std::max(1., std::ceil(distance / dt - rounding));
    const double equal    = distance / parts;
    // Far from the landing time, or if only rounding differs, the asked step is kept: what was
    // assembled for it stays valid.
    return parts > 2 || std::abs(equal - dt) < rounding * dt ? dt : equal;
  }


  void
  Clock::advance(const double dt)
  {
    const double landing = next_landing();
    time += dt;
    if (std::abs(time - landing) < rounding * std::max(dt, 1e-300))
      time = landing;
    ++step;
  }
} // namespace undine
