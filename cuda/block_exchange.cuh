// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_block_exchange_cuh
#define undine_cuda_block_exchange_cuh

#include "flagged_words.cuh"

#include <undine/particles/execution/sums.h>

namespace undine::particles
{
  /// How the blocks of a launch give numbers to each other, in rounds. Every block takes part in
  /// every round; what one round wrote is overwritten in the next but one, when everybody has read
  /// it.
  ///
  /// A counter tells when all blocks have handed out their sums. It orders nothing, the flags of
  /// the numbers do: but all blocks that look at one word find out twice as fast as when they look
  /// at the words of all others.
  class BlockExchange
  {
  public:
    static constexpr int          most_blocks     = 160;
    static constexpr int          most_sums       = 6;
    static constexpr int          stride          = 8;     ///< words of a block
    static constexpr unsigned int most_rounds     = 60000; ///< of a launch
    static constexpr int          rounds_of_setup = 16;    ///< of a launch, at most

    /// Global memory.
    struct Workspace
    {
      unsigned int *counter;     ///< of blocks, starts at zero; every round adds 2^31 to it
      FlaggedWord  *sums;        ///< 2 * most_blocks * stride
      FlaggedWord  *values;      ///< 2 * n_values
      int           n_values;    ///< that all blocks together hand out in a round
      unsigned int  first_round; ///< never used before
    };

    /// By all threads of the block, which must know the counter's phase before one counts in.
    __device__ explicit BlockExchange(const Workspace &workspace)
      : workspace(workspace)
      , round(workspace.first_round)
      , phase(counted() & flip)
    {
      __syncthreads();
    }

    __device__ __forceinline__ void
    begin_round()
    {
      ++round;
    }

    /// Hand out value number k.
    __device__ __forceinline__ void
    put_value(const int k, const float value) const
    {
      put(values() + k, flagged(value, round));
    }

    /// Wait for values number from[k]; nullptr: nobody takes it. Afterwards a warp needs a
    /// __syncwarp() to go on together.
    template <int count>
    __device__ __forceinline__ void
    get_values(float *const (&to)[count], const int (&from)[count]) const
    {
      FlaggedWord word[count];
      bool        complete;
      do
        {
          complete = true;
#pragma unroll
          for (int k = 0; k < count; ++k)
            word[k] = look_at(values() + from[k]);
#pragma unroll
          for (int k = 0; k < count; ++k)
            complete = complete && is_of(word[k], round);
        }
      while (!complete);
#pragma unroll
      for (int k = 0; k < count; ++k)
        if (to[k] != nullptr)
          *to[k] = number_in(word[k]);
    }

    /// Hand out number k of this block's share of sums, by one thread each; then count_in() in a
    /// thread of the same warp.
    __device__ __forceinline__ void
    put_sum(const int k, const double value) const
    {
      put(of_block(blockIdx.x) + k, flagged_long(value, round));
    }

    __device__ __forceinline__ void
    count_in() const
    {
      const unsigned int share = blockIdx.x == 0 ? flip - (gridDim.x - 1) : 1;
      asm volatile("red.relaxed.gpu.global.add.u32 [%0], %1;" ::"l"(workspace.counter), "r"(share)
                   : "memory");
    }

    /// Until all blocks have counted in; by whole warps.
    __device__ __forceinline__ void
    wait() const
    {
      if ((threadIdx.x & 31) == 0)
        while ((counted() & flip) == phase_before())
          ;
      __syncwarp();
    }

    /// A block's share of the sums. As after get_values(), a warp needs a __syncwarp() before it
    /// goes on together.
    template <int count>
    __device__ __forceinline__ Sums<count>
                               share_of(const int block) const
    {
      constexpr int words = (count + 1) / 2 * 2;
      FlaggedWord   word[words];
      bool          complete;
      do
        {
          complete = true;
#pragma unroll
          for (int k = 0; k < words; k += 2)
            look_at_two(word[k], word[k + 1], of_block(block) + k);
#pragma unroll
          for (int k = 0; k < count; ++k)
            complete = complete && is_long_of(word[k], round);
        }
      while (!complete);
      Sums<count> share;
#pragma unroll
      for (int k = 0; k < count; ++k)
        share.values[k] = long_number_in(word[k]);
      return share;
    }

    /// Exchange one number in a round without other sums: the share of each block, in the thread
    /// that has its number. By the whole block.
    __device__ __forceinline__ double
    exchange(const double value)
    {
      if (threadIdx.x < 32)
        {
          if (threadIdx.x == 0)
            {
              put_sum(0, value);
              count_in();
            }
          wait();
        }
      __syncthreads();
      const double share =
        threadIdx.x < gridDim.x ? share_of<1>(static_cast<int>(threadIdx.x))[0] : 0.;
      __syncwarp();
      return share;
    }

  private:
    /// The counter's highest bit until all blocks have counted in.
    __device__ __forceinline__ unsigned int
    phase_before() const
    {
      const unsigned int rounds = round - workspace.first_round - 1;
      return phase ^ (rounds % 2 * flip);
    }

    __device__ __forceinline__ FlaggedWord *
    values() const
    {
      return workspace.values + (round & 1) * static_cast<std::size_t>(workspace.n_values);
    }

    __device__ __forceinline__ FlaggedWord *
    of_block(const int block) const
    {
      return workspace.sums + ((round & 1) * most_blocks + block) * stride;
    }

    __device__ __forceinline__ unsigned int
    counted() const
    {
      unsigned int value;
      asm volatile("ld.relaxed.gpu.global.u32 %0, [%1];"
                   : "=r"(value)
                   : "l"(workspace.counter)
                   : "memory");
      return value;
    }

    static constexpr unsigned int flip = 1u << 31;

    Workspace    workspace;
    unsigned int round;
    unsigned int phase; ///< highest bit of the counter before the first round
  };
} // namespace undine::particles

#endif
