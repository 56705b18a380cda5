// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_device_executor_cuh
#define undine_cuda_device_executor_cuh

#include "device_error.cuh"
#include "device_kernels.cuh"
#include "device_stopwatch.cuh"
#include "find_device.h"
#include "resident/bodies.cuh"
#include "resident/solver.cuh"

#include <undine/particles/pressure/damped_iterations.h>

#include <cub/device/device_scan.cuh>

#include <algorithm>
#include <memory>
#include <string>

namespace undine::particles
{
  /// Runs passes on a CUDA device, see HostExecutor. Passes are enqueued; download() and wait()
  /// wait for them.
  class DeviceExecutor
  {
  public:
    using Team = DeviceTeam;

    /// Particles.
    static constexpr int multigrid_pays_from = 300000;
    static constexpr int room_pays_from      = 100000;

    /// On the device of this number, which the thread works on from now on. Throws InputError if
    /// there is none.
    explicit DeviceExecutor(const unsigned int device)
    {
      const std::string reason = reason_without_device(device);
      if (!reason.empty())
        throw InputError(reason);
      check_device(cudaSetDevice(device), "to be chosen");
      check_device(cudaGetDeviceProperties(&properties, device), "to describe itself");
      check_device(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "to start");
      resident          = ResidentSolver(properties, stream);
      bodies            = ResidentBodies(properties, stream);
      workspace.counter = allocate<unsigned int>(1);
      for (auto &partial : workspace.partial)
        partial = allocate<Sums<Team::most_sums>>(Team::most_blocks);
    }

    DeviceExecutor(const DeviceExecutor &) = delete;

    ~DeviceExecutor()
    {
      stopwatch.reset();
      resident.release(*this);
      bodies.release(*this);
      release(workspace.counter);
      for (auto *partial : workspace.partial)
        release(partial);
      cudaFree(scan_memory);
      cudaStreamDestroy(stream);
    }

    /// Of the host: none are used.
    void
    set_threads(const int)
    {
    }

    std::string
    describe() const
    {
      return std::string(properties.name) + " with " +
             std::to_string(properties.multiProcessorCount) + " multiprocessors";
    }

    template <class T>
    T *
    allocate(const std::size_t n) const
    {
      T *memory = nullptr;
      if (n == 0)
        return memory;
      if (cudaMalloc(&memory, n * sizeof(T)) == cudaErrorMemoryAllocation)
        {
          cudaGetLastError(); // forgets the error
          std::size_t free = 0, total = 0;
          cudaMemGetInfo(&free, &total);
          throw InputError("the device has no room for another " + megabytes(n * sizeof(T)) + ": " +
                           megabytes(free) + " of " + megabytes(total) +
                           " are free. Use fewer particles, or the executor 'host'.");
        }
      check_device(cudaGetLastError(), "to give memory");
      clear(memory, n);
      return memory;
    }

    template <class T>
    void
    release(T *memory) const
    {
      cudaFree(memory);
    }

    template <class T>
    void
    upload(T *to, const T *from, const std::size_t n) const
    {
      copy(to, from, n, cudaMemcpyHostToDevice);
      wait();
    }

    template <class T>
    void
    download(T *to, const T *from, const std::size_t n) const
    {
      copy(to, from, n, cudaMemcpyDeviceToHost);
      wait();
    }

    /// Within the device.
    template <class T>
    void
    duplicate(T *to, const T *from, const std::size_t n) const
    {
      copy(to, from, n, cudaMemcpyDeviceToDevice);
    }

    template <class T>
    void
    clear(T *memory, const std::size_t n) const
    {
      if (n > 0)
        check_device(cudaMemsetAsync(memory, 0, n * sizeof(T), stream), "to clear memory");
    }

    template <class Function>
    void
    for_each(const int n, const Function &f) const
    {
      if (n <= 0)
        return;
      launch(kernels::for_each<Function>, n, f);
    }

    template <int size, class Number, class Function>
    void
    for_each_with_room(const int n, const Function &f) const
    {
      if (n <= 0)
        return;
      launch(kernels::for_each_with_room<size, Number, Function>, n, f);
    }

    template <class Function>
    void
    run(const int n, const Function &f)
    {
      run_team(n, f);
    }

    template <class Function>
    void
    run_team(const int n, const Function &f)
    {
      const int threads = team_threads(n, 32);
      launch_team(threads > kernels::few_threads ? kernels::run<Function, kernels::team_threads, 2>
                                                 : kernels::run<Function, kernels::few_threads, 1>,
                  n,
                  threads,
                  f);
    }

    template <class Function>
    void
    run_by_lanes(const int n, const Function &f)
    {
      run_team_by_lanes(n, f);
    }

    template <class Function>
    void
    run_team_by_lanes(const int n, const Function &f)
    {
      const int workers = n * DeviceLanes::number, threads = team_threads(workers, 128);
      launch_team(threads > 128 ? kernels::run<Function, kernels::team_threads, 1>
                                : kernels::run<Function, 128, 1>,
                  workers,
                  threads,
                  f);
    }

    template <int dim>
    void
    run_by_lanes(const int n, const ElasticStep<dim, float> &step)
    {
      if (bodies.can_run(step))
        bodies.run(*this, step, workspace);
      else
        run_team_by_lanes(n, step);
    }

    /// Solves systems that fit in the shared memories of the multiprocessors there.
    template <class Value>
    void
    run(const int n, const ConjugateGradients<float, PackedEntry, Value> &f)
    {
      if (resident.can_run(n, f))
        resident.run(*this, n, f, workspace);
      else
        run_team(n, f);
    }

    /// Where conjugate gradients are resident, iterations cost so little that they are better.
    template <class Value>
    void
    run(const int n, const DampedIterations<float, PackedEntry, Value> &f)
    {
      if (resident.can_run(n, f.base))
        run(n, f.base);
      else
        run_team(n, f);
    }

    void
    exclusive_scan(const int n, const int *in, int *out)
    {
      std::size_t bytes = 0;
      check_device(cub::DeviceScan::ExclusiveSum(nullptr, bytes, in, out, n, stream), "to scan");
      if (bytes > scan_bytes)
        {
          cudaFree(scan_memory);
          scan_memory = allocate<char>(bytes);
          scan_bytes  = bytes;
        }
      check_device(cub::DeviceScan::ExclusiveSum(scan_memory, bytes, in, out, n, stream),
                   "to scan");
    }

    void
    wait() const
    {
      check_device(cudaStreamSynchronize(stream), "during a pass");
    }

    /// Time phases from now on.
    void
    time_phases()
    {
      if (stopwatch == nullptr)
        stopwatch = std::make_unique<DeviceStopwatch>(stream);
    }

    void
    enter(const Phase phase)
    {
      if (stopwatch != nullptr)
        stopwatch->enter(phase);
    }

    /// Of a phase since time_phases() [s].
    double
    seconds(const Phase phase) const
    {
      return stopwatch == nullptr ? 0. : stopwatch->seconds()[static_cast<int>(phase)];
    }

  private:
    static std::string
    megabytes(const std::size_t bytes)
    {
      return std::to_string(bytes >> 20) + " MB";
    }

    template <class T>
    void
    copy(T *to, const T *from, const std::size_t n, const cudaMemcpyKind kind) const
    {
      if (n > 0)
        check_device(cudaMemcpyAsync(to, from, n * sizeof(T), kind, stream), "to copy");
    }

    /// A pass that lines up behind the last one, see kernels::line_up() and wait_for_last_pass().
    template <class Kernel, class Function>
    void
    launch(const Kernel kernel, const int n, const Function &f) const
    {
      constexpr int       threads = kernels::for_each_threads;
      cudaLaunchAttribute attribute;
      attribute.id = cudaLaunchAttributeProgrammaticStreamSerialization;
      attribute.val.programmaticStreamSerializationAllowed = 1;
      cudaLaunchConfig_t config                            = {};
      config.gridDim                                       = dim3((n + threads - 1) / threads);
      config.blockDim                                      = dim3(threads);
      config.stream                                        = stream;
      config.attrs                                         = &attribute;
      config.numAttrs                                      = properties.major >= 9 ? 1 : 0;
      check_device(cudaLaunchKernelEx(&config, kernel, n, f), "to start a pass");
    }

    /// Together as many workers as there is work for and room.
    template <class Kernel, class Function>
    void
    launch_team(const Kernel kernel, const int n, const int threads, const Function &f)
    {
      int blocks = 0;
      check_device(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, threads, 0),
                   "to plan a pass");
      blocks               = std::min({blocks * properties.multiProcessorCount,
                                       (n + threads - 1) / threads,
                                       int(Team::most_blocks)});
      Function copy        = f;
      void    *arguments[] = {&copy, &workspace};
      check_device(cudaLaunchCooperativeKernel(
                     kernel, dim3(std::max(1, blocks)), dim3(threads), arguments, 0, stream),
                   "to start a pass");
    }

    /// Small passes spread over all multiprocessors in small blocks.
    int
    team_threads(const int n, const int least) const
    {
      const int each = (n + properties.multiProcessorCount - 1) / properties.multiProcessorCount;
      return std::clamp((each + 31) / 32 * 32, least, kernels::team_threads);
    }

    cudaDeviceProp                   properties;
    cudaStream_t                     stream;
    ResidentSolver                   resident;
    ResidentBodies                   bodies;
    Team::Workspace                  workspace   = {};
    char                            *scan_memory = nullptr;
    std::size_t                      scan_bytes  = 0;
    std::unique_ptr<DeviceStopwatch> stopwatch;
  };
} // namespace undine::particles

#endif
