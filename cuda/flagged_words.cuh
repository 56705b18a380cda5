// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_flagged_words_cuh
#define undine_cuda_flagged_words_cuh

#include <undine/particles/math/vector.h>

#include <cuda_runtime.h>

namespace undine::particles
{
  /// A number together with the round of an exchange that it belongs to, written and read at once.
  /// A reader who finds the round that it waits for has the right number, so that blocks can hand
  /// numbers to each other without a fence.
  using FlaggedWord = unsigned long long;

  /// A number in single precision; rounds repeat after 2^32. @{
  __device__ __forceinline__ FlaggedWord
  flagged(const float number, const unsigned int round)
  {
    return (static_cast<FlaggedWord>(round) << 32) | __float_as_uint(number);
  }

  __device__ __forceinline__ bool
  is_of(const FlaggedWord word, const unsigned int round)
  {
    return static_cast<unsigned int>(word >> 32) == round;
  }

  __device__ __forceinline__ float
  number_in(const FlaggedWord word)
  {
    return __uint_as_float(static_cast<unsigned int>(word));
  }
  /// @}

  /// A number with 36 bits of mantissa; rounds repeat after 2^16. @{
  __device__ __forceinline__ FlaggedWord
  flagged_long(const double number, const unsigned int round)
  {
    return (static_cast<FlaggedWord>(__double_as_longlong(number)) & ~FlaggedWord(0xffff)) |
           (round & 0xffff);
  }

  __device__ __forceinline__ bool
  is_long_of(const FlaggedWord word, const unsigned int round)
  {
    return ((static_cast<unsigned int>(word) ^ round) & 0xffff) == 0;
  }

  __device__ __forceinline__ double
  long_number_in(const FlaggedWord word)
  {
    return __longlong_as_double(static_cast<long long>(word & ~FlaggedWord(0xffff)));
  }
  /// @}

  __device__ __forceinline__ void
  put(FlaggedWord *to, const FlaggedWord word)
  {
    asm volatile("st.relaxed.gpu.global.u64 [%0], %1;" ::"l"(to), "l"(word) : "memory");
  }

  __device__ __forceinline__ FlaggedWord
  look_at(const FlaggedWord *from)
  {
    FlaggedWord word;
    asm volatile("ld.relaxed.gpu.global.u64 %0, [%1];" : "=l"(word) : "l"(from) : "memory");
    return word;
  }

  /// Two at once, from an even place.
  __device__ __forceinline__ void
  look_at_two(FlaggedWord &first, FlaggedWord &second, const FlaggedWord *from)
  {
    asm volatile("ld.relaxed.gpu.global.v2.u64 {%0, %1}, [%2];"
                 : "=l"(first), "=l"(second)
                 : "l"(from)
                 : "memory");
  }


  /// A vector together with its round, in one word of 16 bytes.
  template <int dim>
  struct alignas(16) FlaggedVector
  {
    Vector<dim, float> vector;
    unsigned int       round;
  };

  template <int dim>
  __device__ __forceinline__ void
  put(FlaggedVector<dim> *to, const Vector<dim, float> &vector, const unsigned int round)
  {
    static_assert(sizeof(FlaggedVector<dim>) == 16, "it must fit into a word");
    const unsigned long long low =
      __float_as_uint(vector[0]) | (static_cast<FlaggedWord>(__float_as_uint(vector[1])) << 32);
    asm volatile("{ .reg .b128 word; mov.b128 word, {%1, %2}; st.relaxed.gpu.global.b128 [%0], "
                 "word; }" ::"l"(to),
                 "l"(low),
                 "l"(flagged(vector[dim - 1], round))
                 : "memory");
  }

  template <int dim>
  __device__ __forceinline__ FlaggedVector<dim>
                             look_at(const FlaggedVector<dim> *from)
  {
    unsigned long long low, high;
    asm volatile("{ .reg .b128 word; ld.relaxed.gpu.global.b128 word, [%2]; mov.b128 {%0, %1}, "
                 "word; }"
                 : "=l"(low), "=l"(high)
                 : "l"(from)
                 : "memory");
    FlaggedVector<dim> word;
    word.vector[0]       = number_in(low);
    word.vector[1]       = __uint_as_float(static_cast<unsigned int>(low >> 32));
    word.vector[dim - 1] = number_in(high);
    word.round           = static_cast<unsigned int>(high >> 32);
    return word;
  }
} // namespace undine::particles

#endif
