// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_device_team_cuh
#define undine_cuda_device_team_cuh

#include "device_lanes.cuh"

#include <undine/particles/execution/share.h>
#include <undine/particles/execution/sums.h>

#include <cuda_runtime.h>

namespace undine::particles
{
  /// Lets all blocks of a launch wait for each other; they must all be resident. With
  /// cooperative_groups::grid_group::sync() instead, passes in double precision took up to 15 % longer. The counter starts
  /// at zero and is left ready for the next launch: a round adds 2^31 to it, so that the highest
  /// bit changes when the last block arrives.
  class GridBarrier
  {
  public:
    __device__ explicit GridBarrier(unsigned int *counter)
      : counter(counter)
    {
      if (gridDim.x > 1 && threadIdx.x == 0)
        phase = read() & flip;
    }

    /// What any thread wrote before is visible to all after.
    __device__ void
    wait()
    {
      __syncthreads();
      if (gridDim.x == 1)
        return;
      if (threadIdx.x == 0)
        {
          const unsigned int share = blockIdx.x == 0 ? flip - (gridDim.x - 1) : 1;
          asm volatile("red.release.gpu.global.add.u32 [%0], %1;" ::"l"(counter), "r"(share)
                       : "memory");
          while ((read() & flip) == phase)
            ;
          phase ^= flip;
        }
      __syncthreads();
    }

  private:
    __device__ unsigned int
    read() const
    {
      unsigned int value;
      asm volatile("ld.acquire.gpu.global.u32 %0, [%1];" : "=r"(value) : "l"(counter) : "memory");
      return value;
    }

    static constexpr unsigned int flip = 1u << 31;

    unsigned int *counter;
    unsigned int  phase = 0;
  };


  /// Works on a part of a pass while the others wait.
  struct LoneBlock
  {
    template <class Function>
    __device__ __forceinline__ void
    for_each_spread(const int n, const Function &f) const
    {
      for (int i = static_cast<int>(threadIdx.x); i < n; i += static_cast<int>(blockDim.x))
        f(i);
    }

    template <class Function>
    __device__ __forceinline__ void
    for_each_by_lanes(const int n, const Function &f) const
    {
      for (int i = static_cast<int>(threadIdx.x) / DeviceLanes::count(); i < n;
           i += static_cast<int>(blockDim.x) / DeviceLanes::count())
        f(i, DeviceLanes());
    }

    __device__ void
    sync() const
    {
      __syncthreads();
    }
  };


  /// The threads of one launch, see HostTeam. Every block has a contiguous share of the indices.
  class DeviceTeam
  {
  public:
    static constexpr int most_sums   = 8;
    static constexpr int most_blocks = 1024;
    static constexpr int most_warps  = 32; ///< of a block

    /// Global memory of a pass.
    struct Workspace
    {
      unsigned int    *counter;    ///< of the barrier
      Sums<most_sums> *partial[2]; ///< one a block
    };

    __device__
    DeviceTeam(const Workspace &workspace, Sums<most_sums> *of_warps)
      : barrier(workspace.counter)
      , workspace(workspace)
      , of_warps(of_warps)
    {
    }

    __device__ __forceinline__ Share
    share(const int n) const
    {
      const int each =
        ((n + static_cast<int>(gridDim.x) - 1) / static_cast<int>(gridDim.x) + 31) / 32 * 32;
      const int begin = static_cast<int>(blockIdx.x) * each;
      return {min(n, begin), min(n, begin + each)};
    }

    template <class Function>
    __device__ __forceinline__ void
    for_each_of(const Share &share, const Function &f) const
    {
      for (int i = share.begin + static_cast<int>(threadIdx.x); i < share.end;
           i += static_cast<int>(blockDim.x))
        f(i);
    }

    template <class Fetch, class Function>
    __device__ __forceinline__ void
    for_each_of(const Share &share, const Fetch &fetch, const Function &f) const
    {
      constexpr int together = 3;
      const int     threads  = static_cast<int>(blockDim.x);
      int           i        = share.begin + static_cast<int>(threadIdx.x);
      for (; i + (together - 1) * threads < share.end; i += together * threads)
        {
          decltype(fetch(0)) fetched[together];
#pragma unroll
          for (int k = 0; k < together; ++k)
            fetched[k] = fetch(i + k * threads);
#pragma unroll
          for (int k = 0; k < together; ++k)
            f(i + k * threads, fetched[k]);
        }
      for (; i < share.end; i += threads)
        f(i, fetch(i));
    }

    template <class Function>
    __device__ __forceinline__ void
    for_each(const int n, const Function &f) const
    {
      for_each_of(share(n), f);
    }

    template <class Function>
    __device__ __forceinline__ void
    for_each_by_lanes(const int n, const Function &f) const
    {
      const int share = (n + static_cast<int>(gridDim.x) - 1) / static_cast<int>(gridDim.x);
      const int begin = static_cast<int>(blockIdx.x) * share;
      const int end   = min(n, begin + share);
      for (int i = begin + static_cast<int>(threadIdx.x) / DeviceLanes::count(); i < end;
           i += static_cast<int>(blockDim.x) / DeviceLanes::count())
        f(i, DeviceLanes());
    }

    template <class Function>
    __device__ __forceinline__ void
    for_each_spread(const int n, const Function &f) const
    {
      for (int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x); i < n;
           i += static_cast<int>(gridDim.x * blockDim.x))
        f(i);
    }

    template <class Function>
    __device__ __forceinline__ void
    alone(const Function &f) const
    {
      if (blockIdx.x != 0)
        return;
      LoneBlock block;
      f(block);
    }

    /// The order of additions depends on the size of the launch only.
    template <int count, class Function>
    __device__ __forceinline__ Sums<count>
                               sum(const int n, const Function &f)
    {
      Sums<count> mine;
      for_each(n, [&](const int i) { f(i, mine); });
      return total(mine);
    }

    /// The sums of all threads' parts; as sync().
    template <int count>
    __device__ __forceinline__ Sums<count>
                               total(Sums<count> mine)
    {
      static_assert(count <= most_sums, "no room for so many sums");
      reduce_block(mine, workspace.partial[parity] + blockIdx.x);
      sync();
      // One warp reads: all together would crowd the memory.
      if (threadIdx.x < 32)
        {
          Sums<count> all;
          for (int b = threadIdx.x; b < static_cast<int>(gridDim.x); b += 32)
            for (int k = 0; k < count; ++k)
              all[k] += __ldcg(&workspace.partial[parity][b].values[k]);
          reduce_warp(all);
          if (threadIdx.x == 0)
            for (int k = 0; k < count; ++k)
              of_warps[0][k] = all[k];
        }
      __syncthreads();
      Sums<count> total;
      for (int k = 0; k < count; ++k)
        total[k] = of_warps[0][k];
      __syncthreads();
      parity = 1 - parity;
      return total;
    }

    __device__ void
    sync()
    {
      barrier.wait();
    }

    __device__ void
    sync_own() const
    {
      __syncthreads();
    }

    __device__ bool
    is_first() const
    {
      return blockIdx.x == 0 && threadIdx.x == 0;
    }

  private:
    /// All lanes get the sums over the warp.
    template <int count>
    __device__ __forceinline__ static void
    reduce_warp(Sums<count> &sums)
    {
      for (int distance = 16; distance > 0; distance /= 2)
        for (int k = 0; k < count; ++k)
          sums[k] += __shfl_xor_sync(0xffffffffu, sums[k], distance);
    }

    template <int count>
    __device__ __forceinline__ void
    reduce_block(Sums<count> &mine, Sums<most_sums> *result)
    {
      const int warp = threadIdx.x / 32, lane = threadIdx.x & 31;
      reduce_warp(mine);
      if (lane == 0)
        for (int k = 0; k < count; ++k)
          of_warps[warp][k] = mine[k];
      __syncthreads();
      if (warp > 0)
        return;
      Sums<count> total;
      if (lane < static_cast<int>(blockDim.x) / 32)
        for (int k = 0; k < count; ++k)
          total[k] = of_warps[lane][k];
      reduce_warp(total);
      if (lane == 0)
        for (int k = 0; k < count; ++k)
          result->values[k] = total[k];
    }

    GridBarrier      barrier;
    Workspace        workspace;
    Sums<most_sums> *of_warps; ///< shared memory of the block
    int              parity = 0;
  };
} // namespace undine::particles

#endif
