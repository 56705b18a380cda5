// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_block_sums_cuh
#define undine_cuda_block_sums_cuh

#include "block_exchange.cuh"

namespace undine::particles
{
  /// Some sums over all threads of all blocks of a launch, taken together. The first warps of each
  /// block collect what blocks hand out; the others have time for something else.
  template <int count>
  class BlockSums
  {
  public:
    static constexpr int threads = 512, warps = threads / 32;

    /// Warps that collect, one block a thread.
    static constexpr int collectors = BlockExchange::most_blocks / 32;

    static constexpr int spread = count <= 4 ? 4 : 8; ///< sums that a warp reduces together

    struct Shared
    {
      float of_warps[spread][warps];
      float of_blocks[spread][collectors]; ///< 32 each
    };

    __device__ explicit BlockSums(Shared &shared)
      : shared(shared)
    {
    }

    /// Add the threads' parts; by all warps. Others may read the result after __syncthreads().
    __device__ __forceinline__ void
    add(const float (&sums)[count]) const
    {
      const int lane = threadIdx.x & 31;
      float     parts[spread];
#pragma unroll
      for (int k = 0; k < spread; ++k)
        parts[k] = k < count ? sums[k] : 0.f;
      const int which = reduce(parts);
      if (lane % (32 / spread) == 0)
        shared.of_warps[which][threadIdx.x / 32] = parts[0];
    }

    /// After add() and __syncthreads(), by the collectors, in a round of theirs: take(block, share)
    /// for the share of each block, by whole warps; zero for those that are not there.
    template <class Take>
    __device__ __forceinline__ void
    collect(const BlockExchange &exchange, const Take &take) const
    {
      const int block = threadIdx.x, blocks = gridDim.x, lane = threadIdx.x & 31;
      if (block < 32)
        hand_out(exchange);
      exchange.wait(); // each warp for itself: racecheck does not understand named barriers
      auto share = exchange.template share_of<count>(min(block, blocks - 1));
      __syncwarp();
      if (block >= blocks) // the last one's has been read again
        share = Sums<count>();
      take(block, share);
      float parts[spread];
#pragma unroll
      for (int k = 0; k < spread; ++k)
        parts[k] = k < count ? static_cast<float>(share.values[k]) : 0.f;
      const int which = reduce(parts);
      if (lane % (32 / spread) == 0)
        shared.of_blocks[which][threadIdx.x / 32] = parts[0];
    }

    /// Over all blocks, after collect() and __syncthreads().
    __device__ __forceinline__ Sums<count>
                               total() const
    {
      Sums<count> sums;
#pragma unroll
      for (int k = 0; k < count; ++k)
#pragma unroll
        for (int part = 0; part < collectors; ++part)
          sums.values[k] += shared.of_blocks[k][part];
      return sums;
    }

  private:
    /// Over the warp. Each step halves the lanes that a sum is spread over, or the sums in a lane:
    /// in the end it has one, whose number is returned.
    __device__ __forceinline__ static int
    reduce(float (&parts)[spread])
    {
      const int lane  = threadIdx.x & 31;
      int       which = 0;
#pragma unroll
      for (int distance = 16, half = spread / 2; distance > 0; distance /= 2, half /= 2)
        if (half > 0)
          {
            const bool upper = (lane & distance) != 0;
            which += upper ? half : 0;
#pragma unroll
            for (int k = 0; k < half; ++k)
              {
                const float mine  = upper ? parts[k + half] : parts[k];
                const float other = upper ? parts[k] : parts[k + half];
                parts[k]          = mine + __shfl_xor_sync(0xffffffffu, other, distance);
              }
          }
        else
          parts[0] += __shfl_xor_sync(0xffffffffu, parts[0], distance);
      return which;
    }

    /// This block's sums; by the first warp.
    __device__ __forceinline__ void
    hand_out(const BlockExchange &exchange) const
    {
      constexpr int at_once = 32 / warps;
      const int     lane    = threadIdx.x;
#pragma unroll
      for (int first = 0; first < count; first += at_once)
        {
          const int k   = first + lane / warps;
          float     sum = shared.of_warps[k][lane % warps];
#pragma unroll
          for (int distance = warps / 2; distance > 0; distance /= 2)
            sum += __shfl_xor_sync(0xffffffffu, sum, distance);
          if (lane % warps == 0 && k < count)
            exchange.put_sum(k, sum);
        }
      if (lane == 0)
        exchange.count_in();
    }

    Shared &shared;
  };
} // namespace undine::particles

#endif
