// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/swing.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    /// How much larger the jumps in the last quarter of so many steps must be than in the first,
    /// and how large compared with the largest signal.
    struct Window
    {
      unsigned int length;
      double       ratio, material;
    };

    // An energy that grows by 1 % a step grows by 2.1 between quarters that are 75 steps apart, an
    // amplitude by 1.45. In fewer steps means are less certain.
    constexpr std::array<Window, 4> windows{
      {{16, 5., 0.1}, {32, 2., 0.01}, {64, 1.5, 0.01}, {100, 1.4, 0.01}}};

    constexpr double       rounding       = 1e-12;
    constexpr unsigned int least_window   = 6;  // that a mode shows in
    constexpr unsigned int first_steps    = 10; // may jump as they like
    constexpr unsigned int mean_of_record = 8;
    constexpr double       more_than_ever = 1.2;  // of the record
    constexpr double       relative_ratio = 1.2;  // by which jumps grow more than the signal
    constexpr double       least_share    = 0.8;  // of a mode in all that jumps
    constexpr double       least_root     = 0.95; // noise makes a root smaller than it is
    constexpr double       longest_period = 4;    // steps
    constexpr double       a_third        = 1. / 3;


    double
    norm(const Swing::Signal &signal)
    {
      return std::sqrt(signal[0] * signal[0] + signal[1] * signal[1] + signal[2] * signal[2]);
    }


    double
    product(const Swing::Signal &a, const Swing::Signal &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }


    std::string
    words(const double period)
    {
      return period < 2.2 ? "swings from step to step"
                          : fmt::format("swings with a period of {:.2g} steps", period);
    }
  } // namespace


  void
  Swing::observe(const double time, const double dt, const Signal &signal)
  {
    Moment now{time, {}, 0, 0, norm(signal), 0};
    Signal slope{};
    for (unsigned int axis = 0; axis < 3; ++axis)
      {
        slope[axis]    = (signal[axis] - last[axis]) / dt;
        now.jump[axis] = (slope[axis] - last_slope[axis]) * dt;
      }
    last       = signal;
    last_slope = slope;
    largest    = std::max(largest, now.signal);
    if (++n_steps < 3)
      return; // there is no slope before
    now.size = norm(now.jump);
    now.sum  = now.size;
    if (!moments.empty())
      {
        now.sum += moments.back().sum;
        now.record = moments.back().record;
      }
    moments.push_back(now);
    if (moments.size() > windows.back().length + 2)
      moments.pop_front();
    if (moments.size() > mean_of_record && n_steps >= first_steps + mean_of_record)
      {
        const double mean     = mean_size(mean_of_record, 0);
        moments.back().record = std::max(now.record, mean);
        peak                  = std::max(peak, mean);
        if (found && mean < a_third * peak)
          {
            died_away = found;
            found.reset();
          }
      }
    for (const auto &window : windows)
      if (moments.size() > window.length)
        judge(window.length, window.ratio, window.material);
  }


  /// The mean size of jumps in the steps after that which is `first` steps ago until `last`.
  double
  Swing::mean_size(const unsigned int first, const unsigned int last) const
  {
    return std::max(0., before(last).sum - before(first).sum) / (first - last);
  }


  double
  Swing::largest_signal(const unsigned int first, const unsigned int last) const
  {
    double result = 0;
    for (unsigned int steps = last; steps < first; ++steps)
      result = std::max(result, before(steps).signal);
    return result;
  }


  void
  Swing::judge(const unsigned int window, const double least_ratio, const double material)
  {
    const unsigned int    quarter = window / 4;
    std::array<double, 4> sizes;
    for (unsigned int k = 0; k < 4; ++k)
      sizes[k] = mean_size(quarter * (4 - k), quarter * (3 - k));
    const bool grows = sizes[3] > sizes[2] && sizes[2] > sizes[1] && sizes[1] > sizes[0] &&
                       sizes[3] >= least_ratio * sizes[0]; // (V5)
    if (!grows || sizes[3] < material * largest ||
        sizes[3] < more_than_ever * before(window).record) // (V6)
      return;
    const double now    = largest_signal(quarter, 0);
    const double before = largest_signal(window, window - quarter);
    if (sizes[3] < now && sizes[3] * before < relative_ratio * sizes[0] * now)
      return;
    const auto fit = recurrence(window); // (V7)
    if (fit.share >= least_share && fit.growth >= least_root && fit.period <= longest_period)
      note(window, fit);
  }


  /// The factor is that of means over quarters of windows of one length.
  void
  Swing::note(const unsigned int window, const Recurrence &recurrence)
  {
    if (!found)
      {
        found.emplace();
        found->since = before(window).time;
        found->what  = "amplitude";
        first_step   = n_steps - window;
        first_window = window;
        first_size   = mean_size(window, window - window / 4);
        peak         = 0;
      }
    found->until         = moments.back().time;
    found->mode          = words(recurrence.period);
    const auto   quarter = first_window / 4;
    const double size    = mean_size(quarter, 0);
    const double least   = rounding * size;
    found->factor =
      std::pow(size / std::max(first_size, least), 1. / (n_steps - first_step - quarter));
  }


  Swing::Recurrence
  Swing::recurrence(const unsigned int window) const
  {
    // Normal equations. The little that is added to their diagonal decides where only one mode is
    // there, for which there are many recurrences.
    double one = 0, other = 0, mixed = 0, right_one = 0, right_other = 0, squares = 0;
    for (unsigned int steps = 0; steps + 2 < window; ++steps)
      {
        const auto &next = before(steps).jump, &now = before(steps + 1).jump,
                   &last_one = before(steps + 2).jump;
        one += product(now, now);
        other += product(last_one, last_one);
        mixed += product(now, last_one);
        right_one += product(next, now);
        right_other += product(next, last_one);
        squares += product(next, next);
      }
    Recurrence result;
    result.period = std::numeric_limits<double>::infinity();
    if (!(squares > 0))
      return result;
    const double little = 1e-9 * (one + other);
    one += little;
    other += little;
    const double determinant = one * other - mixed * mixed;
    const double a           = (right_one * other - right_other * mixed) / determinant;
    const double b           = (right_other * one - right_one * mixed) / determinant;
    result.share             = (a * right_one + b * right_other) / squares;

    const double discriminant = a * a / 4 + b;
    if (discriminant < 0)
      {
        result.growth = std::sqrt(-b);
        result.period = 2 * M_PI / std::acos(std::clamp(a / 2 / result.growth, -1., 1.));
      }
    else
      {
        result.growth = std::abs(a) / 2 + std::sqrt(discriminant);
        if (a < 0)
          result.period = 2;
      }
    return result;
  }


  double
  Swing::gain(const unsigned int window) const
  {
    if (window >= moments.size())
      return 0;
    const double before = largest_signal(window, window - window / 4);
    return before > 0 ? largest_signal(window / 4, 0) / before : 0;
  }


  std::string
  Swing::mode(const unsigned int window) const
  {
    const auto length = std::min<std::size_t>(window, moments.empty() ? 0 : moments.size() - 1);
    if (length < least_window)
      return "monotonic";
    const auto fit = recurrence(length);
    if (fit.share < least_share || fit.period > length / 2.)
      return "monotonic";
    return words(fit.period);
  }
} // namespace undine
