// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/machine.h>
#include <undine/driver/measured_costs.h>
#include <undine/driver/size_check.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    constexpr unsigned int enough = 5; // steps; the first is not counted, which sets up solvers
  }


  MeasuredCosts::MeasuredCosts(Log &log, const Clock &start, const MPI_Comm communicator)
    : log(log)
    , start(start)
    , communicator(communicator)
  {
  }


  void
  MeasuredCosts::observe(const Clock &clock)
  {
    const auto now = std::chrono::steady_clock::now();
    if (clock.step == start.step + 1)
      {
        first         = clock;
        time_of_first = now;
      }
    if (clock.step != start.step + enough)
      return;
    const double memory  = dealii::Utilities::MPI::sum(memory_in_use(), communicator);
    const double seconds = std::chrono::duration<double>(now - time_of_first).count();
    const double each    = seconds / (clock.step - first.step);
    const double by_time =
      seconds * (clock.end_time - clock.time) / std::max(clock.time - first.time, 1e-300);
    const double by_steps = each * (double(clock.maximum_steps) - clock.step);
    log.print("measured: {} of memory, {} a step, {} for the rest",
              readable_bytes(memory),
              readable_seconds(each),
              readable_seconds(std::max(0., std::min(by_time, by_steps))));
  }
} // namespace undine
