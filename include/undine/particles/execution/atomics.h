// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_execution_atomics_h
#define undine_particles_execution_atomics_h

#include <undine/particles/math/host_device.h>

#include <cstdint>
#include <cstring>

namespace undine::particles
{
  /// Only operations whose result does not depend on their order: a run gives the same bits twice.
  /// @{

  /// Add to a counter; the value before is any that is free.
  UNDINE_HOST_DEVICE
  int
  atomic_add(int *counter, const int value)
  {
#ifdef __CUDA_ARCH__
    return atomicAdd(counter, value);
#else
    return __atomic_fetch_add(counter, value, __ATOMIC_RELAXED);
#endif
  }

  UNDINE_HOST_DEVICE
  void
  atomic_or(unsigned int *flags, const unsigned int value)
  {
#ifdef __CUDA_ARCH__
    atomicOr(flags, value);
#else
    __atomic_fetch_or(flags, value, __ATOMIC_RELAXED);
#endif
  }

  /// Raise `*largest` to `value`. Both stand for numbers that are not negative, by their bits,
  /// whose order is the same; not-a-number is above all.
  UNDINE_HOST_DEVICE
  void
  atomic_maximum(std::uint32_t *largest, const float value)
  {
#ifdef __CUDA_ARCH__
    atomicMax(largest, __float_as_uint(value));
#else
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    std::uint32_t seen = __atomic_load_n(largest, __ATOMIC_RELAXED);
    while (seen < bits && !__atomic_compare_exchange_n(
                            largest, &seen, bits, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
      ;
#endif
  }

  UNDINE_HOST_DEVICE
  float
  number_of_bits(const std::uint32_t bits)
  {
    float value;
    memcpy(&value, &bits, sizeof(value));
    return value;
  }
  /// @}
} // namespace undine::particles

#endif
