// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_row_shares_cuh
#define undine_cuda_row_shares_cuh

#include "block_exchange.cuh"

namespace undine::particles
{
  /// Replaces numbers by the sums up to them, but the first by zero; by one warp.
  __device__ __forceinline__ void
  sum_up(int *numbers, const int n)
  {
    const int lane   = threadIdx.x & 31;
    int       before = 0;
    for (int chunk = 0; chunk < n; chunk += 32)
      {
        const int place = chunk + lane;
        int       sum   = place > 0 && place < n ? numbers[place] : 0;
        for (int distance = 1; distance < 32; distance *= 2)
          {
            const int other = __shfl_up_sync(0xffffffffu, sum, distance);
            sum += lane >= distance ? other : 0;
          }
        if (place < n)
          numbers[place] = before + sum;
        before += __shfl_sync(0xffffffffu, sum, 31);
      }
  }

  /// Shares the rows of a matrix that are not empty among the blocks of a launch: each gets as many
  /// as the others, but the last ones, in the order of the matrix.
  class RowShares
  {
  public:
    /// Exchanges how many rows there are in each block's part of the matrix.
    __device__ __forceinline__
    RowShares(const int n, const int *counts, BlockExchange &exchange)
      : n(n)
      , counts(counts)
      , part((n + static_cast<int>(gridDim.x) - 1) / static_cast<int>(gridDim.x))
    {
      __shared__ int shared[BlockExchange::most_blocks + 1];
      const int      blocks = gridDim.x;
      before                = shared;
      exchange.begin_round();
      const int counted = scan(blockIdx.x, 0, nullptr);
      const int share   = static_cast<int>(exchange.exchange(counted));
      if (static_cast<int>(threadIdx.x) < blocks)
        before[threadIdx.x + 1] = share;
      __syncthreads();
      if (threadIdx.x < 32)
        sum_up(before, blocks + 1);
      __syncthreads();
      const int total = before[blocks];
      most            = (total + blocks - 1) / blocks;
      begin           = min(total, static_cast<int>(blockIdx.x) * most);
      end             = min(total, begin + most);
    }

    /// Of this block.
    __device__ int
    size() const
    {
      return end - begin;
    }

    /// Of any block.
    __device__ int
    largest_size() const
    {
      return most;
    }

    /// The rows of this block, in order.
    __device__ __forceinline__ void
    list(int *rows) const
    {
      const int blocks = gridDim.x;
      int       first  = 0;
      while (before[first + 1] <= begin && first + 1 < blocks)
        ++first;
      for (int block = first; block < blocks && before[block] < end; ++block)
        scan(block, before[block], rows);
    }

  private:
    /// Go through the rows of a part in order. Those that are not empty get numbers from `number`
    /// on; if there are `rows`, those with numbers begin ... end-1 are put there. Returns how many
    /// are not empty.
    __device__ __forceinline__ int
    scan(const int block, const int number, int *rows) const
    {
      __shared__ int of_warps[32];
      const int      first = block * part, last = min(n, first + part);
      const int      warp = threadIdx.x / 32, lane = threadIdx.x & 31, warps = blockDim.x / 32;
      int            next = number;
      for (int chunk = first; chunk < last; chunk += blockDim.x)
        {
          const int          row  = chunk + threadIdx.x;
          const bool         mine = row < last && counts[row] > 0;
          const unsigned int all  = __ballot_sync(0xffffffffu, mine);
          if (lane == 0)
            of_warps[warp] = __popc(all);
          __syncthreads();
          const int of_warp = lane < warps ? of_warps[lane] : 0;
          const int own =
            next + __popc(all & ((1u << lane) - 1)) +
            static_cast<int>(__reduce_add_sync(0xffffffffu, lane < warp ? of_warp : 0));
          next += static_cast<int>(__reduce_add_sync(0xffffffffu, of_warp));
          if (rows != nullptr && mine && own >= begin && own < end)
            rows[own - begin] = row;
          __syncthreads();
        }
      return next - number;
    }

    int        n;
    const int *counts;
    int        part;   ///< rows of the matrix that a block counts
    int       *before; ///< rows that are not empty before each block's part
    int        begin = 0, end = 0, most = 0;
  };
} // namespace undine::particles

#endif
