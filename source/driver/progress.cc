// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/progress.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    constexpr double first_pause = 5, longest_pause = 60; // within a step [s]


    double
    seconds_since(const std::chrono::steady_clock::time_point moment)
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - moment).count();
    }


    std::string
    readable(const double seconds)
    {
      if (seconds < 100)
        return fmt::format("{:.0f} s", seconds);
      if (seconds < 6000)
        return fmt::format("{:.0f} min", seconds / 60);
      return fmt::format("{:.1f} h", seconds / 3600);
    }
  } // namespace


  Progress::Progress(Log &log, const Clock &start)
    : log(log)
    , start(start)
    , begin(std::chrono::steady_clock::now())
    , last_line(begin)
    , last_step(begin)
    , pause_within(first_pause)
  {
    log.print("\n{:>8} {:>12} {:>11} {:>7} {:>9} {:>7} {:>7}  left",
              "step",
              "time [s]",
              "dt [s]",
              "Newton",
              "reduction",
              "linear",
              "done");
  }


  double
  Progress::share_done(const Clock &clock) const
  {
    const double by_time  = (clock.time - start.time) / (clock.end_time - start.time);
    const double by_steps = double(clock.step - start.step) / (clock.maximum_steps - start.step);
    return std::min(1., std::max(by_time, by_steps));
  }


  void
  Progress::report(const Clock &clock, const Report &report)
  {
    constexpr double pause = 0.5; // wall seconds between lines
    last_step              = std::chrono::steady_clock::now();
    pause_within           = first_pause;
    if (clock.step != start.step + 1 && !clock.ended() && seconds_since(last_line) < pause &&
        report.cuts == 0 && !log.has_notes(report))
      {
        log.print_notes(report); // none, but it learns what has passed
        return;
      }
    last_line         = std::chrono::steady_clock::now();
    const double done = share_done(clock);
    log.print(
      "{:>8} {:>12.5g} {:>11.4g} {:>7} {:>9.1e} {:>7} {:>6.1f}%  {}{}",
      clock.step,
      clock.time,
      report.dt,
      report.newton_iterations,
      report.newton_reduction,
      report.linear_iterations,
      100 * done,
      readable(seconds_since(begin) * (1 - done) / std::max(done, 1e-12)),
      (report.cuts > 0 ? fmt::format("   step cut {} time(s)", report.cuts) : "") +
        (report.is_by_fallback ? "   implicit Euler" : "") +
        (report.rejections > 0 ? fmt::format(", {} for its error", report.rejections) : "") +
        (report.creations.number > 0
           ? fmt::format(", {} for the energy that it created", report.creations.number)
           : "") +
        (report.error_in_time ? fmt::format("   error in time {:.2g}", *report.error_in_time)
                              : ""));
    log.print_notes(report);
  }


  void
  Progress::within_step(const std::string &how_far)
  {
    if (seconds_since(std::max(last_line, last_step)) < pause_within)
      return;
    log.print("{:>8} {}", "...", how_far);
    last_line    = std::chrono::steady_clock::now();
    pause_within = std::min(2 * pause_within, longest_pause);
  }
} // namespace undine
