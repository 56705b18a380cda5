// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_banded_inverse_cuh
#define undine_cuda_banded_inverse_cuh

#include <cuda_runtime.h>

namespace undine::particles
{
  /// Rows of the inverse of a symmetric, positive definite matrix with entries near its diagonal
  /// only, by Cholesky's method. By a whole block, in shared memory.
  class BandedInverse
  {
  public:
    static constexpr int width = 32; ///< the diagonal and entries to one side of it

    /// `memory` has bytes(n).
    __device__
    BandedInverse(const int n, char *memory)
      : n(n)
      , band(reinterpret_cast<float *>(memory))
      , inverse_pivots(band + width * n)
    {
    }

    __device__ static int
    bytes(const int n)
    {
      return 4 * (width + 1) * n;
    }

    /// Entry (k, k + l).
    __device__ __forceinline__ float &
    at(const int k, const int l) const
    {
      return band[width * k + l];
    }

    /// Entries farther than `reach` from the diagonal are zero. Unknowns whose pivot is less than
    /// `least` of their diagonal depend on others: they are left out, as if they were zero.
    __device__ __forceinline__ void
    factorize(const int reach, const float least)
    {
      const int warps = blockDim.x / 32, l = threadIdx.x & 31;
      if (static_cast<int>(threadIdx.x) < n)
        inverse_pivots[threadIdx.x] = least * at(threadIdx.x, 0);
      __syncthreads();
      for (int k = 0; k < n; ++k)
        {
          const float pivot   = at(k, 0);
          const float inverse = pivot > inverse_pivots[k] ? 1 / pivot : 0.f;
          for (int m = 1 + static_cast<int>(threadIdx.x) / 32; m <= reach; m += warps)
            if (m <= l && l <= reach && k + l < n)
              at(k + m, l - m) -= inverse * at(k, m) * at(k, l);
          __syncthreads();
          if (threadIdx.x == 0)
            inverse_pivots[k] = inverse;
        }
      __syncthreads();
    }

    /// Row `row` of the inverse; by one warp.
    __device__ __forceinline__ void
    solve(const int row, const int reach, float *result) const
    {
      const int l     = threadIdx.x & 31;
      float     value = l == 0 ? 1.f : 0.f; // of unknown k + l
      for (int k = 0; k < row; k += 32)
        if (k + l < row)
          result[k + l] = 0;
      for (int k = row; k < n; ++k)
        {
          const float scaled = inverse_pivots[k] * __shfl_sync(0xffffffffu, value, 0);
          const float entry  = l <= reach ? at(k, l) : 0.f;
          if (l == 0)
            result[k] = scaled;
          value = __shfl_down_sync(0xffffffffu, value - entry * scaled, 1);
          if (l == 31)
            value = 0;
        }
      __syncwarp();
      value = n - 1 - l >= 0 ? result[n - 1 - l] : 0.f; // of unknown k - l
      for (int k = n - 1; k >= 0; --k)
        {
          const float x     = __shfl_sync(0xffffffffu, value, 0);
          const int   other = k - l;
          const float factor =
            l > 0 && l <= reach && other >= 0 ? at(other, l) * inverse_pivots[other] : 0.f;
          const float next = k - 32 >= 0 ? result[k - 32] : 0.f;
          if (l == 0)
            result[k] = x;
          value = __shfl_down_sync(0xffffffffu, value - factor * x, 1);
          if (l == 31)
            value = next;
          __syncwarp();
        }
    }

  private:
    int    n;
    float *band;
    float *inverse_pivots; ///< least pivots before
  };
} // namespace undine::particles

#endif
