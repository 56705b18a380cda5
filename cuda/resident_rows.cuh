// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_resident_rows_cuh
#define undine_cuda_resident_rows_cuh

#include <undine/particles/pressure_matrix.h>

namespace undine::particles
{
  /// The rows of the matrix that a block works on, in its shared memory. Blocks share the rows that
  /// are not empty evenly. Columns are numbered locally: all rows that its own rows refer to, its
  /// own among them, in the order of the matrix. A warp works on 32 / lanes rows at once, `lanes`
  /// threads on each.
  struct ResidentRows
  {
    int  n_own;     ///< rows
    int  n_local;   ///< columns
    int  first_own; ///< local number of the first own row
    int  lanes;     ///< threads a row
    int *global;    ///< number in the matrix of a local column
    int *begins;    ///< of the warps' entries
    /// Local column and root of the coefficient, as in PackedEntry; of the slices from `n_inside`
    /// on outside, in global memory. @{
    unsigned int *entries;
    unsigned int *entries_outside;
    int           n_inside;
    /// @}
    float scale; ///< of the coefficients

    __device__ static constexpr int
    rows_at_once(const int lanes)
    {
      return 32 / lanes;
    }

    /// sum_j k_ij x_j for own row i, summed over its lanes, which must all call this.
    template <class Value>
    __device__ __forceinline__ Value
    times(const int slice, const Value *x) const
    {
      Value sum =
        slice < n_inside ? sum_over<4>(slice, entries, x) : sum_over<8>(slice, entries_outside, x);
      for (int distance = 1; distance < lanes; distance *= 2)
        sum += shuffled(sum, distance);
      return (scale / (float(PackedEntry::largest) * float(PackedEntry::largest))) * sum;
    }

    __device__ __forceinline__ unsigned int *
    entries_of(const int slice) const
    {
      return slice < n_inside ? entries : entries_outside;
    }

  private:
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
} // namespace undine::particles

#endif
