// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_resident_solver_cuh
#define undine_cuda_resident_solver_cuh

#include "device_error.cuh"
#include "resident/kernel.cuh"

#include <algorithm>
#include <array>

namespace undine::particles
{
  /// Room for what the blocks of a solver exchange. Its rounds must not repeat: long before,
  /// everything is cleared.
  class ExchangeRoom
  {
  public:
    template <class Executor>
    BlockExchange::Workspace
    workspace(const Executor &executor, const std::size_t n_values, const int rounds)
    {
      if (n_values > n)
        {
          release(executor);
          n              = n_values;
          memory.counter = executor.template allocate<unsigned int>(1);
          memory.values  = executor.template allocate<FlaggedWord>(2 * n);
          memory.sums    = executor.template allocate<FlaggedWord>(n_sums);
          next           = 0;
        }
      else if (next > 1u << 31)
        {
          executor.clear(memory.values, 2 * n);
          executor.clear(memory.sums, n_sums);
          next = 0;
        }
      memory.n_values    = static_cast<int>(n);
      memory.first_round = next;
      next += rounds;
      return memory;
    }

    template <class Executor>
    void
    release(const Executor &executor)
    {
      executor.release(memory.counter);
      executor.release(memory.values);
      executor.release(memory.sums);
    }

  private:
    static constexpr std::size_t n_sums = 2 * BlockExchange::most_blocks * BlockExchange::stride;

    BlockExchange::Workspace memory = {};
    std::size_t              n      = 0; ///< values
    unsigned int             next   = 0; ///< round
  };


  /// Starts the resident solvers of a device and has their memory.
  class ResidentSolver
  {
  public:
    ResidentSolver() = default;

    ResidentSolver(const cudaDeviceProp &properties, const cudaStream_t stream)
      : room(static_cast<int>(properties.sharedMemPerBlockOptin) - static_room)
      , blocks(properties.multiProcessorCount)
      , stream(stream)
    {
    }

    template <class Value>
    bool
    can_run(const int n, const ConjugateGradients<float, PackedEntry, Value> &f) const
    {
      return n <= (Components<Value>::count == 1 ? most_rows : most_vectors) &&
             room >= least_room && blocks <= BlockExchange::most_blocks &&
             f.bounds.max_iterations <= static_cast<int>(BlockExchange::most_rounds);
    }

    template <class Executor, class Value>
    void
    run(const Executor                                      &executor,
        const int                                            n,
        const ConjugateGradients<float, PackedEntry, Value> &f,
        DeviceTeam::Workspace                                team_workspace)
    {
      constexpr int count = Components<Value>::count;
      auto          exchange =
        exchanges[count].workspace(executor,
                                   std::max(count * n, blocks * BandedInverse::width),
                                   f.bounds.max_iterations + BlockExchange::rounds_of_setup);
      if (entries_outside == nullptr)
        entries_outside =
          executor.template allocate<unsigned int>(std::size_t(room_outside) * blocks);
      auto         copy        = f;
      ResidentRoom available   = {room, room_outside, entries_outside};
      int          each        = blocks_of_aggregate(n);
      void        *arguments[] = {&copy, &exchange, &team_workspace, &available, &each};
      const void  *kernel      = nullptr;
      if constexpr (count == 1)
        kernel = reinterpret_cast<const void *>(kernels::solve_corrected<Value>);
      else
        kernel = reinterpret_cast<const void *>(kernels::solve_plain<Value>);
      check_device(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, room),
                   "to plan a pass");
      check_device(
        cudaLaunchCooperativeKernel(
          kernel, dim3(blocks), dim3(kernels::resident_threads), arguments, room, stream),
        "to start the solver");
    }

    template <class Executor>
    void
    release(const Executor &executor)
    {
      executor.release(entries_outside);
      for (auto &exchange : exchanges)
        exchange.release(executor);
    }

  private:
    /// So many that aggregates are not much smaller than layers of particles: more of them cost
    /// more than they save. A power of two up to a warp.
    int
    blocks_of_aggregate(const int n) const
    {
      int each = 1;
      while (each < 32 && each * n < least_aggregate * blocks)
        each *= 2;
      return each;
    }

    static constexpr int static_room     = 9 * 1024;  ///< static shared memory of a block, at most
    static constexpr int least_room      = 90 * 1024; ///< shared memory of a block
    static constexpr int least_aggregate = 500;       ///< particles
    static constexpr int most_rows       = 400000;
    static constexpr int most_vectors    = 100000;  ///< few iterations do not pay for more
    static constexpr int room_outside    = 1 << 16; ///< entries of a block in global memory

    int          room   = 0; ///< shared memory of a block [bytes]
    int          blocks = 0; ///< one a multiprocessor
    cudaStream_t stream = nullptr;

    unsigned int               *entries_outside = nullptr;
    std::array<ExchangeRoom, 4> exchanges; ///< by numbers in an unknown
  };
} // namespace undine::particles

#endif
