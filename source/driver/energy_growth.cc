// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/energy_growth.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace undine
{
  namespace
  {
    constexpr std::array<unsigned int, 5> windows{{6, 12, 24, 48, 100}}; // steps
    constexpr unsigned int                shortest_of_unknown_origin = 48;

    // 1 % a step over 100 steps multiplies an energy by 2.7.
    constexpr double least_share  = 0.5; // of the energy there is, that must have been created
    constexpr double least_factor = 2.5;

    // Of works and powers, which are known at the ends of steps only.
    constexpr double share_uncertain = 0.1;

    // Of the largest energy within the longest window: what ripples while it dies away has less.
    constexpr double as_before = 0.9;

    constexpr double rounding_of_energy = 1e-12; // of the energy there is

    // Of the energy at its peak: then what has grown has died away.
    constexpr double died_away = 0.1;
  } // namespace


  void
  EnergyGrowth::observe(const Step &step)
  {
    Moment now{
      step.time, step.energy, step.input, step.input_at_end, step.exchange, step.input_known, 0};
    if (!moments.empty())
      {
        const auto &last = moments.back();
        now.step         = last.step + 1;
        now.input += last.input;
        now.input_at_end += last.input_at_end;
        now.exchange += last.exchange;
      }
    moments.push_back(now);
    if (moments.size() > windows.back() + 1)
      moments.pop_front();
    forget_what_was_lost(created);
    forget_what_was_lost(of_unknown_origin);
    if (!least || now.of_itself() < least->of_itself())
      least = now;

    window_of_growth = 0;
    for (auto window = windows.rbegin(); window != windows.rend(); ++window)
      if (*window < moments.size() && window_of_growth == 0)
        {
          if (is_created(before(*window), step.least))
            note(created, before(*window));
          else if (*window >= shortest_of_unknown_origin && !created &&
                   is_unexplained(*window, step.least))
            note(of_unknown_origin, before(*window));
        }
    if (window_of_growth == 0 && now.step - least->step > windows.back() &&
        is_created(*least, step.least))
      note(created, *least);
  }


  /// By the one of the two rules by which it is more.
  double
  EnergyGrowth::put_in_since(const Moment &begin) const
  {
    const auto &now = moments.back();
    return std::max(now.input - begin.input, now.input_at_end - begin.input_at_end);
  }


  /// (V1), (V2).
  bool
  EnergyGrowth::is_created(const Moment &begin, const double least) const
  {
    const auto &now = moments.back();
    if (!now.input_known || now.energy < as_before * largest_before())
      return false;
    const double excess = now.energy - begin.energy - put_in_since(begin);
    return excess > least && excess >= least_share * now.energy &&
           excess >= share_uncertain * (now.exchange - begin.exchange);
  }


  /// But for the last steps of the shortest window.
  double
  EnergyGrowth::largest_before() const
  {
    double largest = 0;
    for (std::size_t k = 0; k + windows.front() < moments.size(); ++k)
      largest = std::max(largest, moments[k].energy);
    return largest;
  }


  /// (V3): in both halves the energy grows, in the second by at least a quarter of the power of the
  /// first, and less than half of it is known to have been put in.
  bool
  EnergyGrowth::is_unexplained(const unsigned int window, const double least) const
  {
    const auto  &now = moments.back(), &begin = before(window);
    const double gain = now.energy - begin.energy;
    if (!(begin.energy > least) || now.energy < least_factor * begin.energy ||
        now.energy < as_before * largest_before() || put_in_since(begin) >= gain / 2)
      return false;
    const double middle = before(window / 2).energy;
    const double first = std::log(middle / begin.energy), second = std::log(now.energy / middle);
    return first > 0 && second >= first / 4;
  }


  void
  EnergyGrowth::note(std::optional<Growth> &growth, const Moment &begin)
  {
    const auto        &now   = moments.back();
    const unsigned int steps = now.step - begin.step;
    if (!growth)
      {
        growth.emplace();
        growth->since = begin.time;
        growth->what  = "energy";
        peak          = 0;
      }
    growth->since    = std::min(growth->since, begin.time);
    growth->until    = now.time;
    const double put = now.input_known ? now.input - begin.input : 0;
    const double old = std::max(begin.energy + std::max(0., put), rounding_of_energy * now.energy);
    const double alone = old + now.energy - begin.energy - put; // nothing else would be lost
    growth->factor     = std::max(growth->factor, std::pow(alone / old, 1. / steps));
    window_of_growth   = std::min(steps, windows.back());
  }


  void
  EnergyGrowth::forget_what_was_lost(std::optional<Growth> &growth)
  {
    if (!growth)
      return;
    peak = std::max(peak, moments.back().energy);
    if (moments.back().energy > died_away * peak)
      return;
    lost_again = growth;
    growth.reset();
  }
} // namespace undine
