// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef stopwatch_h
#define stopwatch_h

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <limits>

namespace undine_benchmarks
{
  /// Wall seconds that an action takes on all ranks together.
  template <class Action>
  double
  seconds(const Action &action)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    const auto start = std::chrono::steady_clock::now();
    action();
    MPI_Barrier(MPI_COMM_WORLD);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }


  /// Of the fastest of several runs.
  template <class Action>
  double
  least_seconds(const Action &action)
  {
    double result = std::numeric_limits<double>::max();
    for (unsigned int run = 0; run < 7; ++run)
      result = std::min(result, seconds(action));
    return result;
  }
} // namespace undine_benchmarks

#endif
