// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/swing.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  /// So many steps: how much larger the jumps in the last quarter must be than in the first, and
  /// how large compared with the largest signal.
  struct Swing::Window
  {
    unsigned int length;
    double       ratio, material;
  };


  namespace
  {
    // An energy that grows by 1 % a step grows by 2.05 between quarters that are 72 steps apart, an
    // amplitude by 1.43. In fewer steps means are less certain.
    constexpr std::array<Swing::Window, 4> swing_windows{
      {{16, 5., 0.1}, {32, 2., 0.01}, {64, 1.5, 0.01}, {96, 1.4, 0.01}}};

    constexpr unsigned int first_steps    = 10;  // may jump as they like
    constexpr unsigned int mean_of_record = 8;   // steps
    constexpr double       more_than_ever = 1.2; // of the record
    constexpr double       more_than_all  = 1.2; // as the signal grows
    constexpr double       nearly         = 0.8;
    constexpr double       one_mode       = 0.95;        // of all jumps
    constexpr double       least_root     = 0.95;        // noise makes a root smaller than it is
    constexpr double       longest_period = 4;           // steps
    constexpr double       clear = 4, very_clear = 1000; // times the share of noise
    constexpr unsigned int often_enough      = 3;        // more steps in which it grows than others
    constexpr double       a_third           = 1. / 3;
    constexpr unsigned int steps_of_rest     = 48;
    constexpr unsigned int least_window      = 6; // in which a mode shows
    constexpr double       rounding_of_swing = 1e-12;


    double
    product(const Swing::Signal &a, const Swing::Signal &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }


    double
    norm(const Swing::Signal &signal)
    {
      return std::sqrt(product(signal, signal));
    }


    std::string
    words(const double period)
    {
      return period < 2.2 ? "swings from step to step"
                          : fmt::format("swings with a period of {:.2g} steps", period);
    }
  } // namespace


  void
  Swing::observe(const double time, const double dt, const Signal &signal, const double least)
  {
    this->least = least;
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
    if (moments.size() > swing_windows.back().length + 2)
      moments.pop_front();
    follow_size();
    look_for_growth();
  }


  /// The record, and whether what has grown has died away.
  void
  Swing::follow_size()
  {
    if (moments.size() <= mean_of_record || n_steps < first_steps + mean_of_record)
      return;
    const double mean     = mean_size(mean_of_record, 0);
    moments.back().record = std::max(moments.back().record, mean);
    peak                  = std::max(peak, mean);
    if (mean >= a_third * peak)
      last_large = n_steps;
    else if (n_steps - last_large > steps_of_rest)
      for (auto *track : {&sure, &unsure})
        if (track->growth)
          {
            died_away = track->growth;
            *track    = {};
          }
  }


  /// The longest window in which it grows tells most.
  void
  Swing::look_for_growth()
  {
    for (auto *track : {&sure, &unsure})
      track->is_seen = false;
    for (auto window = swing_windows.rbegin(); window != swing_windows.rend() && !sure.is_seen;
         ++window)
      if (moments.size() > window->length)
        if (const auto mode = growing_mode(*window))
          {
            auto &track = mode->is_exponential ? sure : unsure;
            track.n_seen += !track.is_seen;
            track.is_seen = true;
            if (track.n_seen >= often_enough)
              note(track, window->length, *mode);
          }
    for (auto *track : {&sure, &unsure})
      track->n_seen -= !track->is_seen && track->n_seen > 0;
  }


  /// (V5) to (V7). What does not grow, as nearly always, is known by a few differences.
  std::optional<Swing::Recurrence>
  Swing::growing_mode(const Window &window) const
  {
    const unsigned int length = window.length, quarter = length / 4;
    const double       first = mean_size(length, length - quarter), last = mean_size(quarter, 0);
    if (last < nearly * window.ratio * first || last < window.material * largest || last < least ||
        last < more_than_ever * before(length).record)
      return {};
    const double signal       = largest_signal(quarter, 0);
    const double first_signal = largest_signal(length, length - quarter);
    if (last < signal && last * first_signal < more_than_all * first * signal)
      return {};
    auto fit = recurrence(length);
    if (fit.share < one_mode || fit.root < least_root || fit.period > longest_period)
      return {};

    // Samples with a period next to two steps swell and fade although the mode stays as it is.
    const double sine = std::sin(2 * M_PI / fit.period), beat = fit.period / (fit.period - 2);
    const double clearly  = beat <= quarter ? clear : very_clear;
    const bool   turns    = fit.is_complex && sine * sine >= clearly * (1 - fit.share);
    const auto   sizes    = turns ? amplitudes(length, fit) : means(length);
    const double ratio    = sizes[3] / sizes[0];
    const double by_noise = 2 * std::sqrt(std::max(0., 1 - fit.share) / quarter);
    if (!(sizes[3] > sizes[2] && sizes[2] > sizes[1] && sizes[1] > sizes[0] &&
          ratio >= window.ratio * (1 + by_noise)))
      return {};
    fit.is_exponential =
      turns ||
      (sizes[3] - sizes[2] >= std::cbrt(ratio) * (sizes[1] - sizes[0]) && alternates(length));
    return fit;
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


  /// Do all jumps in so many steps change their signs from step to step?
  bool
  Swing::alternates(const unsigned int window) const
  {
    for (unsigned int steps = 0; steps + 1 < window; ++steps)
      if (product(before(steps).jump, before(steps + 1).jump) >= 0)
        return false;
    return true;
  }


  std::array<double, 4>
  Swing::means(const unsigned int window) const
  {
    const unsigned int    quarter = window / 4;
    std::array<double, 4> result;
    for (unsigned int k = 0; k < 4; ++k)
      result[k] = mean_size(quarter * (4 - k), quarter * (3 - k));
    return result;
  }


  /// Of d_n^2 - a d_n d_{n-1} - b d_{n-1}^2, which is the same in all steps of a mode that stays as
  /// it is, whatever the phase in which it is sampled.
  std::array<double, 4>
  Swing::amplitudes(const unsigned int window, const Recurrence &recurrence) const
  {
    const unsigned int    quarter = window / 4;
    std::array<double, 4> result;
    for (unsigned int k = 0; k < 4; ++k)
      {
        double sum = 0;
        for (unsigned int steps = quarter * (3 - k); steps < quarter * (4 - k); ++steps)
          {
            const auto &now = before(steps), &earlier = before(steps + 1);
            sum += now.size * now.size - recurrence.a * product(now.jump, earlier.jump) -
                   recurrence.b * earlier.size * earlier.size;
          }
        result[k] = std::sqrt(std::max(0., sum));
      }
    return result;
  }


  Swing::Recurrence
  Swing::recurrence(const unsigned int window) const
  {
    // Normal equations, in which each step counts as much: else only the last few would, of what
    // grows fast. The little that is added to their diagonal decides where only one mode is there,
    // for which there are many recurrences.
    double one = 0, other = 0, mixed = 0, right_one = 0, right_other = 0, squares = 0;
    for (unsigned int steps = 0; steps + 2 < window; ++steps)
      {
        const auto  &next = before(steps), &now = before(steps + 1), &earlier = before(steps + 2);
        const double size =
          next.size * next.size + now.size * now.size + earlier.size * earlier.size;
        if (!(size > 0))
          continue;
        one += now.size * now.size / size;
        other += earlier.size * earlier.size / size;
        mixed += product(now.jump, earlier.jump) / size;
        right_one += product(next.jump, now.jump) / size;
        right_other += product(next.jump, earlier.jump) / size;
        squares += next.size * next.size / size;
      }
    Recurrence result;
    if (!(squares > 0))
      return result;
    const double little = 1e-9 * (one + other);
    one += little;
    other += little;
    const double determinant = one * other - mixed * mixed;
    result.a                 = (right_one * other - right_other * mixed) / determinant;
    result.b                 = (right_other * one - right_one * mixed) / determinant;
    result.share             = (result.a * right_one + result.b * right_other) / squares;

    const double discriminant = result.a * result.a / 4 + result.b;
    result.is_complex         = discriminant < 0;
    if (result.is_complex)
      {
        result.root   = std::sqrt(-result.b);
        result.period = 2 * M_PI / std::acos(std::clamp(result.a / 2 / result.root, -1., 1.));
      }
    else
      {
        result.root = std::abs(result.a) / 2 + std::sqrt(discriminant);
        if (result.a < 0)
          result.period = 2;
      }
    return result;
  }


  /// The factor is that of means over quarters of windows of one length.
  void
  Swing::note(Track &track, const unsigned int window, const Recurrence &recurrence)
  {
    auto &growth = track.growth;
    if (!growth)
      {
        growth.emplace();
        growth->since    = before(window).time;
        growth->what     = "amplitude";
        track.first_step = n_steps - window;
        track.window     = window;
        track.first_size = mean_size(window, window - window / 4);
        peak             = 0;
      }
    growth->until        = moments.back().time;
    growth->mode         = words(recurrence.period);
    const auto   quarter = track.window / 4;
    const double size    = mean_size(quarter, 0);
    const double begin   = std::max(track.first_size, rounding_of_swing * size);
    growth->factor       = std::pow(size / begin, 1. / (n_steps - track.first_step - quarter));
  }


  double
  Swing::gain(const unsigned int window) const
  {
    if (window >= moments.size())
      return 0;
    const unsigned int quarter = std::max(1u, window / 4);
    const double       before  = largest_signal(window, window - quarter);
    return before > 0 ? largest_signal(quarter, 0) / before : 0;
  }


  std::string
  Swing::mode(const unsigned int window) const
  {
    const auto length = std::min<std::size_t>(window, moments.empty() ? 0 : moments.size() - 1);
    if (length < least_window)
      return "monotonic";
    const auto fit = recurrence(length);
    return fit.share < one_mode || fit.period > length / 2. ? "monotonic" : words(fit.period);
  }
} // namespace undine
