// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_engine_pace_h
#define undine_particles_engine_pace_h

#include <algorithm>
#include <chrono>

namespace undine::particles
{
  /// Says how many sub-steps may follow each other before somebody looks again, by how long the
  /// last ones took.
  class Pace
  {
  public:
    /// `seconds` between looks; zero or less: any number of sub-steps.
    void
    set_pause(const double seconds)
    {
      pause = seconds;
    }

    /// `batch`, or what fits into the pause, but at least one.
    int
    at_most(const int batch) const
    {
      if (pause <= 0 || batch * seconds_each <= pause)
        return batch;
      return std::max(1, static_cast<int>(pause / seconds_each));
    }

    /// A batch begins.
    void
    start()
    {
      begin = Clock::now();
    }

    /// The batch is done.
    void
    stop(const int batch)
    {
      const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      seconds_each         = seconds / std::max(batch, 1);
      since_look += seconds;
    }

    /// Is it time to look? If so, the pause begins anew.
    bool
    is_due()
    {
      if (since_look < pause)
        return false;
      since_look = 0;
      return true;
    }

  private:
    using Clock = std::chrono::steady_clock;

    double            pause        = 0; ///< [s]
    double            seconds_each = 0; ///< of the last sub-steps [s]
    double            since_look   = 0; ///< [s]
    Clock::time_point begin;
  };
} // namespace undine::particles

#endif
