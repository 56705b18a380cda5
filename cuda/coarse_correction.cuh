// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_coarse_correction_cuh
#define undine_cuda_coarse_correction_cuh

#include "banded_inverse.cuh"
#include "block_exchange.cuh"
#include "resident/rows.cuh"

#include <undine/particles/pressure/conjugate_gradients.h>

namespace undine::particles
{
  /// Jacobi's preconditioner alone, see CoarseCorrection.
  class NoCorrection
  {
  public:
    static constexpr bool exists = false;
  };


  /// The second level of the resident solver's preconditioner, D^{-1} + Z E^{-1} Z^T with E = Z^T A
  /// Z [Nicolaides 1987]: the columns of Z are one on the rows of an aggregate and zero elsewhere.
  /// What Jacobi leaves over is smooth, and that is what one number for each aggregate can take
  /// away. Aggregates are what blocks own, so that sums over them travel together with the other
  /// sums of an iteration; every block solves for those that its columns belong to. As blocks own
  /// rows in the order of the matrix, E has a narrow band; what might be outside of it is left out.
  /// What the correction adds follows from step to step like the residual, and now and then from
  /// the residual itself: else rounding would lead it away from there, until steps are no longer
  /// conjugate.
  /// Loose rows belong to no aggregate.
  class CoarseCorrection
  {
  public:
    static constexpr bool exists = true;
    static constexpr int  most   = BlockExchange::most_blocks;

    struct Shared
    {
      int          starts[most];        ///< first rows of the blocks
      int          first_local[most];   ///< local number of the first column that a block owns
      int          near[most];          ///< number among those with local columns; -1: none
      unsigned int couplings[most + 1]; ///< of the own rows, by near aggregate
      float        of_warps[32];
      float        sums[most], residuals[most];     ///< over all aggregates
      float        solution[most];                  ///< of E x = sums, by near aggregate
      float        of_residuals[most];              ///< of E x = residuals
      float        values[most + 1], changes[most]; ///< Z^T-part of the preconditioned residual
    };

    using System = LinearSystem<float, PackedEntry, float>;

    /// `each` blocks make an aggregate, a power of two up to the size of a warp.
    __device__
    CoarseCorrection(Shared &shared, const System &system, const int each)
      : shared(shared)
      , system(system)
      , each(each)
      , n((static_cast<int>(gridDim.x) + each - 1) / each)
    {
    }

    /// The first rows of all blocks; `first` is that of this block.
    __device__ __forceinline__ void
    exchange_starts(BlockExchange &exchange, const int first)
    {
      exchange.begin_round();
      const double start = exchange.exchange(first);
      if (threadIdx.x < gridDim.x)
        shared.starts[threadIdx.x] = static_cast<int>(start);
      if (threadIdx.x < most)
        shared.near[threadIdx.x] = -1;
      __syncthreads();
    }

    /// local_number(row) of the first local column from a row on.
    template <class Function>
    __device__ __forceinline__ void
    find_near(const int n_local, const Function &local_number)
    {
      const int block = threadIdx.x, blocks = gridDim.x;
      if (block < blocks)
        {
          const int begin = local_number(shared.starts[block]);
          const int end   = block + 1 < blocks ? local_number(shared.starts[block + 1]) : n_local;
          shared.first_local[block] = begin;
          if (end > begin)
            shared.near[block / each] = 0;
        }
      __syncthreads();
      int before = 0;
      for (int first = 0; first < n; first += 32)
        {
          const int          k   = first + (threadIdx.x & 31);
          const bool         yes = k < n && shared.near[k] >= 0;
          const unsigned int all = __ballot_sync(0xffffffffu, yes);
          __syncthreads();
          if (threadIdx.x < 32 && yes)
            shared.near[k] = before + __popc(all & ((1u << (threadIdx.x & 31)) - 1));
          before += __popc(all);
        }
      n_near = before;
      __syncthreads();
    }

    /// Bytes in shared memory, a multiple of 16.
    __device__ __forceinline__ int
    room(const int n_local) const
    {
      return (4 * n_near * n + n_local + 15) / 16 * 16;
    }

    /// Bytes that invert() needs besides.
    __device__ __forceinline__ int
    room_for_inversion() const
    {
      return BandedInverse::bytes(n);
    }

    /// This block's part of E, once columns are numbered; `memory` has room() bytes.
    /// for_each_entry(f) calls f(row, local column, root of the coefficient) for the thread's
    /// entries.
    template <class ForEachEntry>
    __device__ __forceinline__ void
    assemble(const ResidentColumns &columns, char *memory, const ForEachEntry &for_each_entry)
    {
      inverse = reinterpret_cast<float *>(memory);
      owners  = reinterpret_cast<unsigned char *>(inverse + n_near * n);
      find_owners(columns);
      if (threadIdx.x <= most)
        shared.couplings[threadIdx.x] = 0;
      if (threadIdx.x == 0)
        shared.values[n_near] = 0;
      __syncthreads();
      int          last = 0, last_row = -1;
      bool         is_loose = false;
      unsigned int sum      = 0;
      for_each_entry([&](const int row, const int local, const unsigned int root) {
        if (row != last_row)
          is_loose = system.is_loose(row);
        last_row        = row;
        const int owner = is_loose ? n_near : owners[local];
        if (owner != last)
          {
            atomicAdd(shared.couplings + last, sum);
            last = owner;
            sum  = 0;
          }
        sum += (root * root) >> shift;
      });
      atomicAdd(shared.couplings + last, sum);
      float of_diagonal = 0;
      for (int own = threadIdx.x; own < columns.n_own; own += blockDim.x)
        {
          const int row = columns.row_of(columns.first_own + own);
          of_diagonal += system.is_loose(row) ? 0.f : system.diagonal[row];
        }
      for (int distance = 16; distance > 0; distance /= 2)
        of_diagonal += __shfl_xor_sync(0xffffffffu, of_diagonal, distance);
      if ((threadIdx.x & 31) == 0)
        shared.of_warps[threadIdx.x / 32] = of_diagonal;
      __syncthreads();
    }

    /// Hand it out, in a round of the caller's; `scale` is that of the matrix. Returns how far from
    /// the diagonal it reaches.
    __device__ __forceinline__ int
    put_row(const BlockExchange &exchange, const float scale) const
    {
      const float unit =
        scale / (float(PackedEntry::largest) * float(PackedEntry::largest)) * float(1 << shift);
      const int  l = threadIdx.x & 31, k = static_cast<int>(blockIdx.x) / each + l;
      const bool is_near = k < n && shared.near[k] >= 0;
      float      value   = is_near ? -unit * shared.couplings[shared.near[k]] : 0.f;
      if (l == 0)
        for (int warp = 0; warp < static_cast<int>(blockDim.x) / 32; ++warp)
          value += shared.of_warps[warp];
      if (threadIdx.x < 32)
        exchange.put_value(static_cast<int>(blockIdx.x) * BandedInverse::width + l, value);
      return 31 - __clz(__ballot_sync(0xffffffffu, is_near) | 1);
    }

    /// Take the rows of all blocks, in the same round, and solve for near aggregates. `memory` has
    /// room_for_inversion().
    __device__ __forceinline__ void
    invert(const BlockExchange &exchange, const int reach, char *memory)
    {
      constexpr int width = BandedInverse::width;
      BandedInverse banded(n, memory);
      constexpr int at_once = 6; // for two rows a warp all
      const int     places = n * width, threads = blockDim.x, blocks = gridDim.x;
      for (int first = threadIdx.x; first < places; first += at_once * threads)
        {
          float sums[at_once] = {};
          for (int of_each = 0; of_each < each; ++of_each)
            {
              float  values[at_once] = {};
              float *to[at_once];
              int    from[at_once];
#pragma unroll
              for (int k = 0; k < at_once; ++k)
                {
                  const int place = min(first + k * threads, places - 1);
                  const int block = place / width * each + of_each, l = place % width;
                  to[k]   = block < blocks && l <= reach ? values + k : nullptr;
                  from[k] = min(block, blocks - 1) * width + l;
                }
              exchange.get_values(to, from);
#pragma unroll
              for (int k = 0; k < at_once; ++k)
                sums[k] += values[k];
            }
#pragma unroll
          for (int k = 0; k < at_once; ++k)
            if (first + k * threads < places)
              banded.at((first + k * threads) / width, threadIdx.x % width) = sums[k];
        }
      __syncthreads();
      banded.factorize(reach, 1e-5f);
      for (int k = threadIdx.x / 32; k < n; k += blockDim.x / 32)
        if (shared.near[k] >= 0)
          banded.solve(k, reach, inverse + shared.near[k] * n);
      __syncthreads();
    }

    /// Take a block's sum; by a whole warp, for blocks that follow each other. @{
    __device__ __forceinline__ void
    take(const int block, const float sum) const
    {
      add_up(block, sum, shared.sums);
    }

    __device__ __forceinline__ void
    take_residual(const int block, const float sum) const
    {
      add_up(block, sum, shared.residuals);
    }
    /// @}

    /// E^{-1} times the sums, for near aggregates; by all warps but the first. @{
    __device__ __forceinline__ void
    solve() const
    {
      solve(shared.sums, shared.solution);
    }

    __device__ __forceinline__ void
    solve_for_residuals() const
    {
      solve(shared.residuals, shared.of_residuals);
    }
    /// @}

    /// The solution for the sums of the first residual is where values start.
    __device__ __forceinline__ void
    start() const
    {
      const int k = threadIdx.x;
      if (k < n_near)
        {
          shared.values[k]  = shared.solution[k];
          shared.changes[k] = 0;
        }
    }

    /// What the residual itself says; then advance().
    __device__ __forceinline__ void
    follow_residual() const
    {
      const int k = threadIdx.x;
      if (k < n_near)
        shared.values[k] = shared.of_residuals[k];
    }

    /// Values after a step of the conjugate gradients, like its residual.
    __device__ __forceinline__ void
    advance(const float alpha, const float beta) const
    {
      const int k = threadIdx.x;
      if (k < n_near)
        {
          const float change = shared.solution[k] + beta * shared.changes[k];
          shared.changes[k]  = change;
          shared.values[k] -= alpha * change;
        }
    }

    /// Whether a local row belongs to an aggregate: 1 or 0.
    __device__ __forceinline__ float
    share_of(const int local) const
    {
      return owners[local] == n_near ? 0.f : 1.f;
    }

    /// What is added to a local unknown.
    __device__ __forceinline__ float
    at(const int local) const
    {
      return shared.values[owners[local]];
    }

  private:
    static constexpr int shift = 12; ///< of squared roots of coefficients, so that sums fit

    __device__ __forceinline__ void
    add_up(const int block, float sum, float (&to)[most]) const
    {
      for (int distance = 1; distance < each; distance *= 2)
        sum += __shfl_xor_sync(0xffffffffu, sum, distance);
      if (block % each == 0 && block / each < n)
        to[block / each] = sum;
    }

    __device__ __forceinline__ void
    solve(const float (&sums)[most], float (&solution)[most]) const
    {
      constexpr int lanes   = 16;
      const int     workers = (static_cast<int>(blockDim.x) - 32) / lanes;
      const int     worker  = (static_cast<int>(threadIdx.x) - 32) / lanes;
      const int     lane    = static_cast<int>(threadIdx.x) % lanes;
      for (int first = 0; first < n_near; first += workers)
        {
          const int    row  = min(first + worker, n_near - 1);
          const float *from = inverse + row * n;
          float        sum  = 0;
#pragma unroll 4
          for (int k = lane; k < n; k += lanes)
            sum += from[k] * sums[k];
          for (int distance = lanes / 2; distance > 0; distance /= 2)
            sum += __shfl_xor_sync(0xffffffffu, sum, distance);
          if (lane == 0 && first + worker < n_near)
            solution[row] = sum;
        }
    }

    /// Near aggregates of the local columns.
    __device__ __forceinline__ void
    find_owners(const ResidentColumns &columns) const
    {
      const int blocks = gridDim.x, warps = blockDim.x / 32;
      for (int block = threadIdx.x / 32; block < blocks; block += warps)
        {
          const int end = block + 1 < blocks ? shared.first_local[block + 1] : columns.n_local;
          for (int local = shared.first_local[block] + (threadIdx.x & 31); local < end; local += 32)
            owners[local] = static_cast<unsigned char>(
              system.is_loose(columns.row_of(local)) ? n_near : shared.near[block / each]);
        }
    }

    Shared        &shared;
    const System  &system;
    int            each;              ///< blocks of an aggregate
    int            n;                 ///< aggregates
    int            n_near  = 0;       ///< of them with local columns
    float         *inverse = nullptr; ///< rows of E^{-1} of near aggregates
    unsigned char *owners  = nullptr; ///< near aggregates of local columns
  };
} // namespace undine::particles

#endif
