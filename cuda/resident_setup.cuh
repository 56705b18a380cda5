// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_resident_setup_cuh
#define undine_cuda_resident_setup_cuh

#include "block_exchange.cuh"
#include "resident_rows.cuh"

namespace undine::particles
{
  /// Fills ResidentRows at the start of a launch.
  class ResidentSetup
  {
  public:
    using Matrix = PressureMatrix<float, PackedEntry>;

    /// `room` bytes of shared memory from `memory` on, and `room_outside` entries for each block in
    /// global memory.
    __device__
    ResidentSetup(const Matrix  &matrix,
                  BlockExchange &exchange,
                  char          *memory,
                  const int      room,
                  unsigned int  *outside,
                  const int      room_outside)
      : matrix(matrix)
      , exchange(exchange)
      , memory(memory)
      , room(room)
      , room_outside(room_outside)
      , n_words((matrix.n + 31) / 32)
    {
      rows.scale           = matrix.scale;
      rows.entries_outside = outside + blockIdx.x * static_cast<std::size_t>(room_outside);
      bitmap               = reinterpret_cast<unsigned int *>(memory + room) - n_words;
      ranks                = reinterpret_cast<int *>(bitmap) - n_words;
    }

    /// Returns false on all blocks if the rows of one do not fit. `per_local` and `per_own` are the
    /// bytes of vectors that will be needed besides.
    __device__ __forceinline__ bool
    fill(const int per_local, const int per_own)
    {
      count_rows();
      bool fits = take_rows();
      if (fits)
        {
          place_entries();
          mark_columns();
          rank_columns();
          const int of_vectors = 16 + rows.n_local * per_local + rows.n_own * per_own;
          fits                 = place_columns(of_vectors);
        }
      if (fits)
        number_columns();
      return everywhere(fits);
    }

    ResidentRows rows;
    char        *vectors = nullptr; ///< free room after the rows

  private:
    __device__ __forceinline__ int
    before_bitmap() const
    {
      return room - 8 * n_words;
    }

    __device__ __forceinline__ bool
    everywhere(const bool fits)
    {
      __shared__ bool result;
      exchange.begin_round();
      if (threadIdx.x < 32)
        {
          Sums<1> misfits;
          misfits[0] = fits ? 0 : 1;
          exchange.put_sums(misfits);
          const double all = exchange.get_sums<1>()[0];
          if (threadIdx.x == 0)
            result = all == 0;
        }
      __syncthreads();
      return result;
    }

    /// How many rows before each block's part of the matrix are not empty.
    __device__ __forceinline__ void
    count_rows()
    {
      __shared__ int before[BlockExchange::most_blocks + 1];
      const int      blocks = gridDim.x;
      part                  = (matrix.n + blocks - 1) / blocks;
      rows_before           = before;
      exchange.begin_round();
      const int counted = scan_part(blockIdx.x, 0, 0, 0);
      if (threadIdx.x < 32)
        {
          Sums<1> mine;
          mine[0] = counted;
          exchange.put_sums(mine);
        }
      if (static_cast<int>(threadIdx.x) < blocks)
        before[threadIdx.x + 1] = static_cast<int>(exchange.share_of(threadIdx.x));
      __syncwarp();
      __syncthreads();
      if (threadIdx.x < 32)
        scan(before, blocks + 1);
      __syncthreads();
    }

    /// Each block gets as many rows that are not empty as the others.
    __device__ __forceinline__ bool
    take_rows()
    {
      const int  blocks = gridDim.x;
      const auto total  = static_cast<long long>(rows_before[blocks]);
      const int  begin  = static_cast<int>(total * blockIdx.x / blocks);
      const int  end    = static_cast<int>(total * (blockIdx.x + 1) / blocks);
      const int  most   = static_cast<int>((total + blocks - 1) / blocks);
      own_rows          = reinterpret_cast<int *>(memory);
      rows.n_own        = end - begin;
      rows.n_local      = 0;
      rows.lanes        = 1;
      while (rows.lanes < 4 && 2 * rows.lanes * most <= static_cast<int>(blockDim.x))
        rows.lanes *= 2;
      rows.begins = own_rows + rows.n_own;
      if (4 * (rows.n_own + n_slices() + 1) > before_bitmap())
        return false;
      int first = 0;
      while (rows_before[first + 1] <= begin && first + 1 < blocks)
        ++first;
      for (int block = first; block < blocks && rows_before[block] < end; ++block)
        scan_part(block, rows_before[block], begin, end);
      return true;
    }

    /// Go through the rows of a part in order. Those that are not empty get numbers from `before`
    /// on; numbers begin ... end-1 become own rows. Returns how many are not empty.
    __device__ __forceinline__ int
    scan_part(const int block, int before, const int begin, const int end)
    {
      __shared__ int of_warps[32];
      const int      first = block * part, last = min(matrix.n, first + part);
      const int      warp = threadIdx.x / 32, lane = threadIdx.x & 31, warps = blockDim.x / 32;
      const int      start = before;
      for (int chunk = first; chunk < last; chunk += blockDim.x)
        {
          const int          row  = chunk + threadIdx.x;
          const bool         mine = row < last && matrix.counts[row] > 0;
          const unsigned int all  = __ballot_sync(0xffffffffu, mine);
          if (lane == 0)
            of_warps[warp] = __popc(all);
          __syncthreads();
          const int of_warp = lane < warps ? of_warps[lane] : 0;
          const int number =
            before + __popc(all & ((1u << lane) - 1)) +
            static_cast<int>(__reduce_add_sync(0xffffffffu, lane < warp ? of_warp : 0));
          before += static_cast<int>(__reduce_add_sync(0xffffffffu, of_warp));
          if (mine && number >= begin && number < end)
            own_rows[number - begin] = row;
          __syncthreads();
        }
      return before - start;
    }

    /// Replaces numbers by the sums up to them, but the first by zero; by one warp.
    __device__ __forceinline__ static void
    scan(int *numbers, const int n)
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

    __device__ __forceinline__ int
    n_slices() const
    {
      const int at_once = ResidentRows::rows_at_once(rows.lanes);
      return (rows.n_own + at_once - 1) / at_once;
    }

    __device__ __forceinline__ int
    row_of_thread(const int slice) const
    {
      return slice * ResidentRows::rows_at_once(rows.lanes) + (threadIdx.x & 31) / rows.lanes;
    }

    /// Where the entries of the slices begin; all rows of a slice get as much room.
    __device__ __forceinline__ void
    place_entries()
    {
      const int warp = threadIdx.x / 32, warps = blockDim.x / 32;
      for (int slice = warp; slice < n_slices(); slice += warps)
        {
          const int own   = row_of_thread(slice);
          const int count = own < rows.n_own ? matrix.counts[own_rows[own]] : 0;
          const int most  = __reduce_max_sync(0xffffffffu, count);
          if ((threadIdx.x & 31) == 0)
            rows.begins[slice + 1] = (most + rows.lanes - 1) / rows.lanes * 32;
        }
      for (int word = threadIdx.x; word < n_words; word += blockDim.x)
        bitmap[word] = 0;
      __syncthreads();
      if (warp == 0)
        scan(rows.begins, n_slices() + 1);
      __syncthreads();
    }

    /// f(row, slice, place, entry) for all of them, some at once. Room that is left over in slices
    /// gets the row itself with the coefficient zero.
    template <class Function>
    __device__ __forceinline__ void
    for_each_entry(const Function &f) const
    {
      constexpr int at_once = 8;
      const int     warp = threadIdx.x / 32, lane = threadIdx.x & 31, warps = blockDim.x / 32;
      for (int slice = warp; slice < n_slices(); slice += warps)
        {
          const int own   = min(row_of_thread(slice), rows.n_own - 1);
          const int row   = own_rows[own];
          const int count = own == row_of_thread(slice) ? matrix.counts[row] : 0;
          const int end   = rows.begins[slice + 1];
          int       k     = lane & (rows.lanes - 1);
          for (int place = rows.begins[slice] + lane; place < end;
               place += at_once * 32, k += at_once * rows.lanes)
            {
              PackedEntry entries[at_once];
#pragma unroll
              for (int m = 0; m < at_once; ++m)
                entries[m] = k + m * rows.lanes < count
                               ? matrix.entries[list_slot(row, k + m * rows.lanes, matrix.capacity)]
                               : PackedEntry{0};
#pragma unroll
              for (int m = 0; m < at_once; ++m)
                if (place + m * 32 < end)
                  f(row, slice, place + m * 32, entries[m]);
            }
        }
    }

    /// Which columns occur.
    __device__ __forceinline__ void
    mark_columns()
    {
      for_each_entry([&](const int row, const int, const int, const PackedEntry entry) {
        mark(row + entry.difference());
      });
      for (int own = threadIdx.x; own < rows.n_own; own += blockDim.x)
        mark(own_rows[own]);
      __syncthreads();
    }

    __device__ __forceinline__ void
    mark(const int column) const
    {
      atomicOr(bitmap + (column >> 5), 1u << (column & 31));
    }

    /// How many columns are before each group of 32.
    __device__ __forceinline__ void
    rank_columns()
    {
      __shared__ int of_warps[33];
      const int      part  = (n_words + blockDim.x - 1) / blockDim.x;
      const int      first = threadIdx.x * part, last = min(n_words, first + part);
      int            count = 0;
      for (int word = first; word < last; ++word)
        count += __popc(bitmap[word]);
      const int warp = threadIdx.x / 32, lane = threadIdx.x & 31;
      int       sum = count;
      for (int distance = 1; distance < 32; distance *= 2)
        {
          const int other = __shfl_up_sync(0xffffffffu, sum, distance);
          sum += lane >= distance ? other : 0;
        }
      if (lane == 31)
        of_warps[warp + 1] = sum;
      __syncthreads();
      if (warp == 0)
        scan(of_warps, blockDim.x / 32 + 1);
      __syncthreads();
      int before   = of_warps[warp] + sum - count;
      rows.n_local = of_warps[blockDim.x / 32];
      for (int word = first; word < last; ++word)
        {
          ranks[word] = before;
          before += __popc(bitmap[word]);
        }
      __syncthreads();
    }

    __device__ __forceinline__ int
    local_number(const int column) const
    {
      return ranks[column >> 5] + __popc(bitmap[column >> 5] & ((1u << (column & 31)) - 1));
    }

    /// As many slices inside as there is room for, besides the columns and vectors. Returns whether
    /// there is enough outside for the others.
    __device__ __forceinline__ bool
    place_columns(const int of_vectors)
    {
      const int slices = n_slices();
      rows.global      = rows.begins + slices + 1;
      rows.entries     = reinterpret_cast<unsigned int *>(rows.global + rows.n_local);
      const int begin  = static_cast<int>(reinterpret_cast<char *>(rows.entries) - memory);
      const int most   = min(room - of_vectors, before_bitmap()) - begin;
      rows.n_inside    = 0;
      while (rows.n_inside < slices && 4 * rows.begins[rows.n_inside + 1] <= most)
        ++rows.n_inside;
      const int inside = rows.begins[rows.n_inside];
      rows.entries_outside -= inside;
      vectors = memory + (begin + 4 * inside + 15) / 16 * 16;
      return most >= 0 && rows.begins[slices] - inside <= room_outside;
    }

    /// Entries with local columns.
    __device__ __forceinline__ void
    number_columns()
    {
      rows.first_own = rows.n_own > 0 ? local_number(own_rows[0]) : 0;
      for_each_entry([&](const int row, const int slice, const int place, const PackedEntry entry) {
        rows.entries_of(slice)[place] =
          (static_cast<unsigned int>(local_number(row + entry.difference()))
           << PackedEntry::weight_bits) |
          (entry.bits & PackedEntry::largest);
      });
      for (int word = threadIdx.x; word < n_words; word += blockDim.x)
        {
          int          number = ranks[word];
          unsigned int bits   = bitmap[word];
          for (; bits != 0; bits &= bits - 1)
            rows.global[number++] = 32 * word + __ffs(bits) - 1;
        }
      __syncthreads();
    }

    Matrix         matrix;
    BlockExchange &exchange;
    char          *memory;
    int            room, room_outside, n_words;
    int            part;        ///< rows of the matrix that a block counts
    int           *rows_before; ///< that are not empty, by block that counted
    int           *own_rows;
    unsigned int  *bitmap; ///< of the columns, at the end of the room until vectors take it
    int           *ranks;  ///< columns before each word of the bitmap
  };
} // namespace undine::particles

#endif
