// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_math_exact_float_h
#define undine_particles_math_exact_float_h

#include <undine/particles/math/host_device.h>

#include <cstdint>

namespace undine::particles
{
  constexpr float two_to_23 = 8388608;

  /// 2^23 + (bits & mask), exactly, where the mask is less than 2^23: these are the mantissa's
  /// bits. The device converts whole numbers at an eighth of the rate at which it adds.
  template <std::uint32_t mask>
  UNDINE_HOST_DEVICE
  float
  float_beyond(const std::uint32_t bits)
  {
    static_assert(mask < 1u << 23, "does not fit in a mantissa");
#ifdef __CUDA_ARCH__
    return __uint_as_float(0x4b000000u | (bits & mask));
#else
    return two_to_23 + static_cast<float>(bits & mask);
#endif
  }
} // namespace undine::particles

#endif
