// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_warp_signal_cuh
#define undine_cuda_warp_signal_cuh

#include <cuda_runtime.h>

#include <nv/target>

namespace undine::particles
{
  /// Some threads of a block let others go on, again and again: between two times all of them meet
  /// at a __syncthreads(). A barrier in shared memory and not a named one, of which
  /// compute-sanitizer's racecheck believes that it undoes __syncthreads().
  class WarpSignal
  {
  public:
    using Shared = unsigned long long; ///< in shared memory

    /// By all threads, `givers` of which will give(). Others may use it after __syncthreads().
    __device__
    WarpSignal(Shared &shared, const int givers)
      : address(static_cast<unsigned int>(__cvta_generic_to_shared(&shared)))
    {
      if (threadIdx.x == 0)
        asm volatile("mbarrier.init.shared.b64 [%0], %1;" ::"r"(address), "r"(givers) : "memory");
    }

    /// What a thread wrote before is visible to those who take() after.
    __device__ __forceinline__ void
    give() const
    {
      asm volatile("{ .reg .b64 state; mbarrier.arrive.shared.b64 state, [%0]; }" ::"r"(address)
                   : "memory");
    }

    /// By those who wait, each time.
    __device__ __forceinline__ void
    take()
    {
      while (!is_given())
        ;
      parity ^= 1;
    }

  private:
    __device__ __forceinline__ bool
    is_given() const
    {
      unsigned int given;
      NV_IF_ELSE_TARGET(NV_PROVIDES_SM_90,
                        (asm volatile("{ .reg .pred given; mbarrier.try_wait.parity.shared.b64 "
                                      "given, [%1], %2; selp.u32 %0, 1, 0, given; }"
                                      : "=r"(given)
                                      : "r"(address), "r"(parity)
                                      : "memory");),
                        (asm volatile("{ .reg .pred given; mbarrier.test_wait.parity.shared.b64 "
                                      "given, [%1], %2; selp.u32 %0, 1, 0, given; }"
                                      : "=r"(given)
                                      : "r"(address), "r"(parity)
                                      : "memory");))
      return given != 0;
    }

    unsigned int address;
    unsigned int parity = 0; ///< of the time that is waited for
  };
} // namespace undine::particles

#endif
