// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_device_stopwatch_cuh
#define undine_cuda_device_stopwatch_cuh

#include "device_error.cuh"

#include <undine/particles/execution/phases.h>

#include <array>
#include <vector>

namespace undine::particles
{
  /// Times phases by events in the stream, without waiting for them.
  class DeviceStopwatch
  {
  public:
    static constexpr std::size_t capacity = 512; ///< events before they are read

    explicit DeviceStopwatch(const cudaStream_t stream)
      : stream(stream)
      , events(capacity)
    {
      for (auto &event : events)
        check_device(cudaEventCreate(&event), "to make a clock");
    }

    DeviceStopwatch(const DeviceStopwatch &) = delete;

    ~DeviceStopwatch()
    {
      for (auto &event : events)
        cudaEventDestroy(event);
    }

    /// The phase before this one ends here.
    void
    enter(const Phase phase)
    {
      if (phases.size() == capacity)
        read();
      check_device(cudaEventRecord(events[phases.size()], stream), "to read its clock");
      phases.push_back(phase);
    }

    /// By Phase [s].
    const std::array<double, static_cast<int>(Phase::count)> &
    seconds()
    {
      read();
      return sums;
    }

  private:
    /// Waits for the last event, which begins the phase that is under way.
    void
    read()
    {
      if (phases.empty())
        return;
      check_device(cudaEventSynchronize(events[phases.size() - 1]), "while it was timed");
      for (std::size_t k = 0; k + 1 < phases.size(); ++k)
        {
          float milliseconds = 0;
          check_device(cudaEventElapsedTime(&milliseconds, events[k], events[k + 1]),
                       "to read its clock");
          sums[static_cast<int>(phases[k])] += 1e-3 * milliseconds;
        }
      std::swap(events[0], events[phases.size() - 1]);
      phases.assign(1, phases.back());
    }

    cudaStream_t                                       stream;
    std::vector<cudaEvent_t>                           events;
    std::vector<Phase>                                 phases; ///< that the events begin
    std::array<double, static_cast<int>(Phase::count)> sums = {};
  };
} // namespace undine::particles

#endif
