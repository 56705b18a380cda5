// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_swing_h
#define undine_driver_swing_h

#include <undine/driver/growth.h>

#include <array>
#include <deque>
#include <limits>
#include <optional>
#include <string>

namespace undine
{
  /// Does a force or a velocity swing with a period of only a few steps, and more and more? Rules
  /// (V4) to (V7) of doc/hard_cases.md.
  class Swing
  {
  public:
    using Signal = std::array<double, 3>; ///< components that a scene has not are zero
    struct Window;

    /// The signal at the end of a step of length `dt` [s], which ends at `time` [s]. Jumps that are
    /// smaller than `least` do not matter.
    void
    observe(double time, double dt, const Signal &signal, double least);

    /// Unless it has died away again. Without `where`.
    const std::optional<Growth> &
    growth() const
    {
      return sure.growth;
    }

    /// The same where a mode with a period next to two steps, which stays as it is, may look like
    /// it.
    const std::optional<Growth> &
    apparent_growth() const
    {
      return unsure.growth;
    }

    /// What has grown and died away.
    const std::optional<Growth> &
    past() const
    {
      return died_away;
    }

    /// How what is not smooth in the last so many steps moves, in words.
    std::string
    mode(unsigned int window) const;

    /// The largest signal in the last quarter of so many steps over that in the first; 0: unknown.
    double
    gain(unsigned int window) const;

  private:
    /// A step.
    struct Moment
    {
      double time;
      Signal jump;   ///< (V4)
      double size;   ///< of the jump
      double sum;    ///< of the sizes so far
      double signal; ///< its size
      double record; ///< of the mean size of jumps so far, but for the first steps of the run
    };

    /// d_{n+1} = a d_n + b d_{n-1}, the best fit.
    struct Recurrence
    {
      double a = 0, b = 0;
      double share          = 0; ///< of the squares of jumps that it explains [1]
      double root           = 0; ///< size of the largest [1]
      bool   is_complex     = false;
      double period         = std::numeric_limits<double>::infinity(); ///< of that root, in steps
      bool   is_exponential = false; ///< does it grow, without a doubt
    };

    /// What grows.
    struct Track
    {
      std::optional<Growth> growth;
      double                first_size = 0; ///< of the jumps
      unsigned int          first_step = 0, window = 0;
      unsigned int          n_seen  = 0;     ///< how many more steps show it than do not
      bool                  is_seen = false; ///< in the last step
    };

    void
    follow_size();
    void
    look_for_growth();
    std::optional<Recurrence>
    growing_mode(const Window &window) const;
    void
    note(Track &track, unsigned int window, const Recurrence &recurrence);
    Recurrence
    recurrence(unsigned int window) const;

    /// In each quarter of so many steps, the oldest first: @{
    std::array<double, 4>
    means(unsigned int window) const;
    std::array<double, 4>
    amplitudes(unsigned int window, const Recurrence &recurrence) const;
    /// @}

    double
    mean_size(unsigned int first, unsigned int last) const;
    double
    largest_signal(unsigned int first, unsigned int last) const;
    bool
    alternates(unsigned int window) const;

    const Moment &
    before(unsigned int steps) const
    {
      return moments[moments.size() - 1 - steps];
    }

    std::deque<Moment>    moments; ///< the last ones
    Signal                last{}, last_slope{};
    double                largest = 0; ///< signal so far
    double                least   = 0; ///< jump that matters
    Track                 sure, unsure;
    std::optional<Growth> died_away;
    double                peak    = 0; ///< of the jumps of what grows
    unsigned int          n_steps = 0, last_large = 0;
  };
} // namespace undine

#endif
