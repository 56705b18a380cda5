// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_measured_costs_h
#define undine_driver_measured_costs_h

#include <undine/base/core/clock.h>
#include <undine/driver/log.h>

#include <deal.II/base/mpi.h>

#include <chrono>

namespace undine
{
  /// Prints, after the first steps of a run, a line with the memory and time that they have taken,
  /// in place of the estimate at the start.
  class MeasuredCosts
  {
  public:
    /// `start` is the clock before the first step.
    MeasuredCosts(Log &log, const Clock &start, MPI_Comm communicator);

    /// A step has been made. Collective.
    void
    observe(const Clock &clock);

  private:
    Log                                  &log;
    const Clock                           start;
    Clock                                 first; ///< after the first step
    std::chrono::steady_clock::time_point time_of_first;
    const MPI_Comm                        communicator;
  };
} // namespace undine

#endif
