// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_block_exchange_cuh
#define undine_cuda_block_exchange_cuh

#include "flagged_words.cuh"

#include <undine/particles/sums.h>

namespace undine::particles
{
  /// How the blocks of a launch give numbers to each other, in rounds. Every block takes part in
  /// every round; what one round wrote is overwritten in the next but one, when everybody has read
  /// it.
  class BlockExchange
  {
  public:
    static constexpr int          most_blocks = 160;
    static constexpr int          most_sums   = 6;
    static constexpr int          stride      = 8;     ///< words of a block
    static constexpr unsigned int most_rounds = 60000; ///< of a launch

    /// Global memory.
    struct Workspace
    {
      FlaggedWord *sums;        ///< 2 * most_blocks * stride
      FlaggedWord *values;      ///< 2 * n_values
      int          n_values;    ///< that all blocks together hand out in a round
      unsigned int first_round; ///< never used before
    };

    __device__ explicit BlockExchange(const Workspace &workspace)
      : workspace(workspace)
      , round(workspace.first_round)
    {
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

    /// Hand out this block's share of sums; by the threads of one warp.
    template <int count>
    __device__ __forceinline__ void
    put_sums(const Sums<count> &sums) const
    {
      const int lane = threadIdx.x & 31;
#pragma unroll
      for (int k = 0; k < count; ++k)
        if (lane == k)
          put(of_block(blockIdx.x) + k, flagged_long(sums.values[k], round));
    }

    /// Sum the shares of all blocks, in a fixed order; by the threads of one warp, who all get it.
    template <int count>
    __device__ __forceinline__ Sums<count>
                               get_sums() const
    {
      constexpr int passes = most_blocks / 32, words = (count + 1) / 2 * 2;
      const int     lane = threadIdx.x & 31;
      FlaggedWord   word[passes][words];
      bool          complete;
      do // all at once: each look takes long
        {
          complete = true;
#pragma unroll
          for (int pass = 0; pass < passes; ++pass)
#pragma unroll
            for (int k = 0; k < words; k += 2)
              look_at_two(word[pass][k],
                          word[pass][k + 1],
                          of_block(min(pass * 32 + lane, static_cast<int>(gridDim.x) - 1)) + k);
#pragma unroll
          for (int pass = 0; pass < passes; ++pass)
#pragma unroll
            for (int k = 0; k < count; ++k)
              complete = complete && is_long_of(word[pass][k], round);
        }
      while (!complete);
      __syncwarp();
      Sums<count> total;
#pragma unroll
      for (int pass = 0; pass < passes; ++pass)
        if (pass * 32 + lane < static_cast<int>(gridDim.x))
#pragma unroll
          for (int k = 0; k < count; ++k)
            total.values[k] += long_number_in(word[pass][k]);
#pragma unroll
      for (int distance = 16; distance > 0; distance /= 2)
#pragma unroll
        for (int k = 0; k < count; ++k)
          total.values[k] += __shfl_xor_sync(0xffffffffu, total.values[k], distance);
      return total;
    }

    /// A block's share of the first sum. As after get_values(), a warp needs a __syncwarp() before
    /// it goes on together.
    __device__ __forceinline__ double
    share_of(const int block) const
    {
      FlaggedWord word;
      do
        word = look_at(of_block(block));
      while (!is_long_of(word, round));
      return long_number_in(word);
    }

  private:
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

    Workspace    workspace;
    unsigned int round;
  };
} // namespace undine::particles

#endif
