// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_near_numbers_cuh
#define undine_cuda_near_numbers_cuh

#include <undine/particles/near_rows.h>
#include <undine/particles/vector.h>

namespace undine::particles
{
  /// How numbers of particles lie in shared memory: vectors by components. @{
  template <class Real>
  struct SharedNumbers
  {
    static constexpr int words = 1;

    using Word  = Real;
    using Value = Real;

    __device__ __forceinline__ static Value
    get(const Word *place, const int)
    {
      return *place;
    }

    __device__ __forceinline__ static void
    put(Word *place, const int, const Real &number)
    {
      *place = number;
    }
  };

  template <int dim, class Real>
  struct SharedNumbers<StoredVector<dim, Real>>
  {
    static constexpr int words = dim;

    using Word  = Real;
    using Value = Vector<dim, Real>;

    __device__ __forceinline__ static Value
    get(const Word *place, const int stride)
    {
      Value result;
#pragma unroll
      for (int axis = 0; axis < dim; ++axis)
        result[axis] = place[axis * stride];
      return result;
    }

    __device__ __forceinline__ static void
    put(Word *place, const int stride, const StoredVector<dim, Real> &vector)
    {
#pragma unroll
      for (int axis = 0; axis < dim; ++axis)
        place[axis * stride] = vector.entries[axis];
    }
  };
  /// @}


  /// Those numbers x_j that some rows refer to, in shared memory: random accesses take a third of
  /// the time that they take in the first cache.
  template <class Stored>
  class NearNumbers
  {
  public:
    using Layout = SharedNumbers<Stored>;
    using Word   = typename Layout::Word;

    /// How many fit.
    __device__ __forceinline__ static constexpr int
    capacity(const int bytes)
    {
      return bytes / static_cast<int>(Layout::words * sizeof(Word));
    }

    /// By all threads of the block, whose dynamic shared memory has room for `n` of them.
    __device__ __forceinline__
    NearNumbers(const Runs<3> &runs, const Stored *x, const int n)
      : n(n)
    {
      int before[4] = {};
#pragma unroll
      for (int k = 0; k < 3; ++k)
        {
          begin[k]      = runs.run[k].begin;
          shift[k]      = before[k] - begin[k];
          before[k + 1] = before[k] + runs.run[k].end - begin[k];
        }
      copy(x, before);
      __syncthreads();
    }

    __device__ __forceinline__ typename Layout::Value
    operator[](const int j) const
    {
      const int place = j + (j >= begin[2] ? shift[2] : j >= begin[1] ? shift[1] : shift[0]);
      return Layout::get(room() + place, n);
    }

  private:
    /// Named anew here, because the compiler must see that it is shared memory.
    __device__ __forceinline__ static Word *
    room()
    {
      extern __shared__ __align__(16) char memory[];
      return reinterpret_cast<Word *>(memory);
    }

    /// The runs that are before[0] ... before[1] - 1 and so on there.
    __device__ __forceinline__ void
    copy(const Stored *x, const int (&before)[4]) const
    {
      constexpr int together = Layout::words == 1 ? 8 : 4; // on the way at the same time
      const int     threads = static_cast<int>(blockDim.x), rank = static_cast<int>(threadIdx.x);
      for (int first = rank; first < before[3]; first += together * threads)
        {
          Stored numbers[together];
#pragma unroll
          for (int k = 0; k < together; ++k)
            {
              const int place = min(first + k * threads, before[3] - 1);
              numbers[k] =
                x[place - (place >= before[2] ? shift[2] : place >= before[1] ? shift[1] : shift[0])];
            }
#pragma unroll
          for (int k = 0; k < together; ++k)
            if (first + k * threads < before[3])
              Layout::put(room() + first + k * threads, n, numbers[k]);
        }
    }

    int n;
    int begin[3], shift[3];
  };
} // namespace undine::particles

#endif
