// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_resident_setup_cuh
#define undine_cuda_resident_setup_cuh

#include "coarse_correction.cuh"
#include "row_shares.cuh"

namespace undine::particles
{
  /// Where there is room for the rows of a block.
  struct ResidentRoom
  {
    int           inside;  ///< bytes of shared memory
    int           outside; ///< entries in global memory
    unsigned int *entries; ///< of all blocks
  };

  /// Fills ResidentRows at the start of a launch, and what the preconditioner's correction needs to
  /// know of them.
  template <class Correction, int most_held>
  class ResidentSetup
  {
  public:
    using Matrix = PressureMatrix<float, PackedEntry>;
    using Rows   = ResidentRows<most_held>;

    __device__
    ResidentSetup(const Matrix       &matrix,
                  BlockExchange      &exchange,
                  Correction         &correction,
                  char               *memory,
                  const ResidentRoom &available)
      : matrix(matrix)
      , exchange(exchange)
      , correction(correction)
      , memory(memory)
      , room(available.inside)
      , room_outside(available.outside)
      , n_words((matrix.n + 31) / 32)
    {
      rows.scale = matrix.scale;
      rows.entries_outside =
        available.entries + blockIdx.x * static_cast<std::size_t>(room_outside);
      bitmap = reinterpret_cast<unsigned int *>(memory + room) - n_words;
      ranks  = reinterpret_cast<int *>(bitmap) - n_words;
    }

    /// Returns false on all blocks if the rows of one do not fit. `per_local` and `per_own` are the
    /// bytes of vectors that will be needed besides.
    __device__ __forceinline__ bool
    fill(const int per_local, const int per_own)
    {
      bool fits = take_rows();
      if constexpr (Correction::exists)
        correction.exchange_starts(exchange, fits && rows.n_own > 0 ? own_rows[0] : matrix.n);
      if (fits)
        {
          place_entries();
          mark_columns();
          rank_columns();
          fits = place_columns(16 + rows.n_local * per_local + rows.n_own * per_own);
        }
      if (fits)
        number_columns();
      return everywhere(fits);
    }

    Rows  rows;
    int   reach   = 0;       ///< of the correction's matrix
    char *vectors = nullptr; ///< free room after the rows

  private:
    __device__ __forceinline__ int
    before_bitmap() const
    {
      return room - 8 * n_words;
    }

    __device__ __forceinline__ bool
    everywhere(const bool fits)
    {
      __shared__ int farthest;
      int            mine = 0;
      exchange.begin_round();
      if constexpr (Correction::exists)
        if (fits)
          mine = correction.put_row(exchange, rows.scale);
      if (threadIdx.x == 0)
        farthest = 0;
      const int share = static_cast<int>(exchange.exchange(fits ? mine : -1));
      if (share > 0)
        atomicMax(&farthest, share);
      const bool everybody = __syncthreads_or(share < 0 ? 1 : 0) == 0;
      reach                = farthest;
      return everybody;
    }

    __device__ __forceinline__ bool
    take_rows()
    {
      const RowShares shares(matrix.n, matrix.counts, exchange);
      const int       most = shares.largest_size();
      own_rows             = reinterpret_cast<int *>(memory);
      rows.n_own           = shares.size();
      rows.n_local         = 0;
      rows.lanes           = 1;
      while (rows.lanes < 4 && 2 * rows.lanes * most <= static_cast<int>(blockDim.x))
        rows.lanes *= 2;
      rows.begins = own_rows + rows.n_own;
      if (4 * (rows.n_own + n_slices() + 1) > before_bitmap())
        return false;
      shares.list(own_rows);
      return true;
    }

    __device__ __forceinline__ int
    n_slices() const
    {
      const int at_once = Rows::rows_at_once(rows.lanes);
      return (rows.n_own + at_once - 1) / at_once;
    }

    __device__ __forceinline__ int
    row_of_thread(const int slice) const
    {
      return slice * Rows::rows_at_once(rows.lanes) + (threadIdx.x & 31) / rows.lanes;
    }

    /// Where the entries of the slices begin that are not held; all rows of a slice get as much
    /// room.
    __device__ __forceinline__ void
    place_entries()
    {
      const int warp = threadIdx.x / 32, warps = blockDim.x / 32;
      rows.n_held = 0;
      for (int slice = warp; slice < n_slices(); slice += warps)
        {
          const int own   = row_of_thread(slice);
          const int count = own < rows.n_own ? matrix.counts[own_rows[own]] : 0;
          const int most  = __reduce_max_sync(0xffffffffu, count);
          const int each  = (most + rows.lanes - 1) / rows.lanes;
          const int held  = slice == warp ? min(each, most_held) : 0;
          if (slice == warp)
            rows.n_held = held;
          if ((threadIdx.x & 31) == 0)
            rows.begins[slice + 1] = (each - held) * 32;
        }
      for (int word = threadIdx.x; word < n_words; word += blockDim.x)
        bitmap[word] = 0;
      __syncthreads();
      if (warp == 0)
        sum_up(rows.begins, n_slices() + 1);
      __syncthreads();
    }

    /// f(k, row, entry) for the entries to hold, some at once; those that are left over get the row
    /// itself with the coefficient zero.
    template <class Function>
    __device__ __forceinline__ void
    for_each_held(const Function &f) const
    {
      constexpr int at_once = 8;
      static_assert(most_held % at_once == 0, "all of them are read at once");
      if (most_held == 0 || rows.n_held == 0)
        return;
      const int slice = Rows::first_slice();
      const int own = min(row_of_thread(slice), rows.n_own - 1), row = own_rows[own];
      const int count = own == row_of_thread(slice) ? matrix.counts[row] : 0;
      const int lane  = threadIdx.x & (rows.lanes - 1);
#pragma unroll
      for (int first = 0; first < most_held; first += at_once)
        {
          PackedEntry entries[at_once];
#pragma unroll
          for (int m = 0; m < at_once; ++m)
            {
              const int k = (first + m) * rows.lanes + lane;
              entries[m] =
                k < count ? matrix.entries[list_slot(row, k, matrix.capacity)] : PackedEntry{0};
            }
#pragma unroll
          for (int m = 0; m < at_once; ++m)
            f(first + m, row, entries[m]);
        }
    }

    /// f(row, slice, place, entry) for all but the first `before` of the rows of a warp's first
    /// slice, some at once; a lane's entries are 32 places apart. Room that is left over in slices
    /// gets the row itself with the coefficient zero.
    template <class Function>
    __device__ __forceinline__ void
    for_each_entry(const int before, const Function &f) const
    {
      constexpr int at_once = 8;
      const int     warp = threadIdx.x / 32, lane = threadIdx.x & 31, warps = blockDim.x / 32;
      for (int slice = warp; slice < n_slices(); slice += warps)
        {
          const int own     = min(row_of_thread(slice), rows.n_own - 1);
          const int row     = own_rows[own];
          const int count   = own == row_of_thread(slice) ? matrix.counts[row] : 0;
          const int skipped = slice == warp ? before : 0;
          const int end     = rows.begins[slice + 1];
          int       k       = skipped * rows.lanes + (lane & (rows.lanes - 1));
          for (int place =
                 rows.begins[slice] + lane - (slice == warp ? rows.n_held - before : 0) * 32;
               place < end;
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
      for_each_entry(0, [&](const int row, const int, const int, const PackedEntry entry) {
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
        sum_up(of_warps, blockDim.x / 32 + 1);
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
      int of_correction = 0, of_inversion = 0;
      if constexpr (Correction::exists)
        {
          correction.find_near(rows.n_local, [&](const int row) {
            return row < matrix.n ? local_number(row) : rows.n_local;
          });
          of_correction = correction.room(rows.n_local);
          of_inversion  = correction.room_for_inversion();
        }
      const int slices = n_slices();
      rows.global      = rows.begins + slices + 1;
      rows.entries     = reinterpret_cast<unsigned int *>(rows.global + rows.n_local);
      const int begin  = static_cast<int>(reinterpret_cast<char *>(rows.entries) - memory);
      const int most =
        min(room - of_vectors, before_bitmap() - 16 - of_inversion) - of_correction - begin;
      rows.n_inside = 0;
      while (rows.n_inside < slices && 4 * rows.begins[rows.n_inside + 1] <= most)
        ++rows.n_inside;
      const int inside = rows.begins[rows.n_inside];
      rows.entries_outside -= inside;
      corrections = memory + (begin + 4 * inside + 15) / 16 * 16;
      vectors     = corrections + of_correction;
      return most >= 0 && rows.begins[slices] - inside <= room_outside;
    }

    /// Entries with local columns.
    __device__ __forceinline__ void
    number_columns()
    {
      rows.first_own = rows.n_own > 0 ? local_number(own_rows[0]) : 0;
      for (int word = threadIdx.x; word < n_words; word += blockDim.x)
        {
          int          number = ranks[word];
          unsigned int bits   = bitmap[word];
          for (; bits != 0; bits &= bits - 1)
            rows.global[number++] = 32 * word + __ffs(bits) - 1;
        }
      __syncthreads();
      if constexpr (Correction::exists)
        correction.assemble(rows, corrections, [&](const auto &f) { number_entries(f); });
      else
        number_entries([](const int, const int, const unsigned int) {});
      __syncthreads();
    }

    /// And f(row, local column, root of the coefficient) for each.
    template <class Function>
    __device__ __forceinline__ void
    number_entries(const Function &f)
    {
      const auto numbered = [&](const int row, const PackedEntry entry) {
        const int          local = local_number(row + entry.difference());
        const unsigned int root  = entry.bits & PackedEntry::largest;
        f(row, local, root);
        return (static_cast<unsigned int>(local) << PackedEntry::weight_bits) | root;
      };
      for_each_entry(rows.n_held,
                     [&](const int row, const int slice, const int place, const PackedEntry entry) {
                       rows.entries_of(slice)[place] = numbered(row, entry);
                     });
      for_each_held([&](const int k, const int row, const PackedEntry entry) {
        rows.held[k] = numbered(row, entry);
      });
    }

    Matrix         matrix;
    BlockExchange &exchange;
    Correction    &correction;
    char          *memory;
    int            room, room_outside, n_words;
    int           *own_rows;
    char          *corrections = nullptr; ///< room of the correction
    unsigned int  *bitmap; ///< of the columns, at the end of the room until vectors take it
    int           *ranks;  ///< columns before each word of the bitmap
  };
} // namespace undine::particles

#endif
