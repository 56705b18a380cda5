// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_resident_rows_cuh
#define undine_cuda_resident_rows_cuh

#include <undine/particles/pressure/pressure_matrix.h>

namespace undine::particles
{
  /// The rows that a block has and the columns that they refer to, its own rows among them,
  /// numbered in the order of the matrix. Blocks share the rows that are not empty evenly.
  struct ResidentColumns
  {
    int  n_own;     ///< rows
    int  n_local;   ///< columns
    int  first_own; ///< local number of the first own row
    int *global;    ///< number in the matrix of a local column

    __device__ int
    row_of(const int local) const
    {
      return global[local];
    }

    __device__ bool
    is_own(const int local) const
    {
      return local >= first_own && local < first_own + n_own;
    }
  };

  /// The rows of the matrix that a block works on, in its shared memory. A warp works on a slice of
  /// 32 / lanes rows at once, `lanes` threads on each; the first entries of its first slice are in
  /// registers, up to most_held of a thread.
  template <int most_held>
  struct ResidentRows : ResidentColumns
  {
    int  lanes;  ///< threads a row
    int *begins; ///< of the warps' entries
    /// Local column and root of the coefficient, as in PackedEntry; of the slices from `n_inside`
    /// on outside, in global memory. @{
    unsigned int *entries;
    unsigned int *entries_outside;
    int           n_inside;
    /// @}
    float scale; ///< of the coefficients

    int          n_held; ///< of this thread's entries, the same number in all lanes of a warp
    unsigned int held[most_held > 0 ? most_held : 1];

    __device__ static constexpr int
    rows_at_once(const int lanes)
    {
      return 32 / lanes;
    }

    /// The slice whose first entries are held.
    __device__ __forceinline__ static int
    first_slice()
    {
      return static_cast<int>(threadIdx.x) / 32;
    }

    /// sum_j k_ij x_j for the rows of a slice, over their lanes, which must all call this. @{
    template <class Value>
    __device__ __forceinline__ Value
    times_first(const Value *x) const
    {
      constexpr int at_once = 4;
      Value         sum     = Value();
#pragma unroll
      for (int first = 0; first < most_held; first += at_once)
        if (first < n_held)
#pragma unroll
          for (int k = first; k < first + at_once; ++k)
            add(sum, held[k], x);
      return scaled(sum + times_stored(first_slice(), x));
    }

    template <class Value>
    __device__ __forceinline__ Value
    times(const int slice, const Value *x) const
    {
      return scaled(times_stored(slice, x));
    }
    /// @}

    __device__ __forceinline__ unsigned int *
    entries_of(const int slice) const
    {
      return slice < n_inside ? entries : entries_outside;
    }

  private:
    template <class Value>
    __device__ __forceinline__ Value
    times_stored(const int slice, const Value *x) const
    {
      return slice < n_inside ? sum_over<4>(slice, entries, x)
                              : sum_over<8>(slice, entries_outside, x);
    }

    /// Over the lanes of a row, in the units of the matrix.
    template <class Value>
    __device__ __forceinline__ Value
    scaled(Value sum) const
    {
      for (int distance = 1; distance < lanes; distance *= 2)
        sum += shuffled(sum, distance);
      return (scale / (float(PackedEntry::largest) * float(PackedEntry::largest))) * sum;
    }

    /// As many entries at once as a thread has the patience to wait for.
    template <int at_once, class Value>
    __device__ __forceinline__ Value
    sum_over(const int slice, const unsigned int *from, const Value *x) const
    {
      Value     sum   = Value();
      const int end   = begins[slice + 1];
      int       place = begins[slice] + (threadIdx.x & 31);
      for (; place + (at_once - 1) * 32 < end; place += at_once * 32)
        {
          unsigned int bits[at_once];
#pragma unroll
          for (int k = 0; k < at_once; ++k)
            bits[k] = from[place + k * 32];
#pragma unroll
          for (int k = 0; k < at_once; ++k)
            add(sum, bits[k], x);
        }
      for (; place < end; place += 32)
        add(sum, from[place], x);
      return sum;
    }

    template <class Value>
    __device__ __forceinline__ static void
    add(Value &sum, const unsigned int bits, const Value *x)
    {
      const float root = static_cast<float>(bits & PackedEntry::largest);
      sum += (root * root) * x[bits >> PackedEntry::weight_bits];
    }

    __device__ static float
    shuffled(const float value, const int distance)
    {
      return __shfl_xor_sync(0xffffffffu, value, distance);
    }

    template <int dim>
    __device__ static Vector<dim, float>
    shuffled(Vector<dim, float> value, const int distance)
    {
      for (int axis = 0; axis < dim; ++axis)
        value[axis] = __shfl_xor_sync(0xffffffffu, value[axis], distance);
      return value;
    }
  };


  /// Rows without neighbours, which belong to no block; by all threads of all blocks.
  template <class Value, class System>
  __device__ __forceinline__ void
  solve_empty_rows(const System &system)
  {
    for (int row = blockIdx.x * blockDim.x + threadIdx.x; row < system.matrix.n;
         row += gridDim.x * blockDim.x)
      if (system.matrix.counts[row] == 0)
        system.solution[row] = (1 / system.diagonal[row]) * Value(system.right_hand_side[row]);
  }
} // namespace undine::particles

#endif
