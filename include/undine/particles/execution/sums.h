// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_execution_sums_h
#define undine_particles_execution_sums_h

#include <undine/particles/math/host_device.h>

namespace undine::particles
{
  /// Some sums over all particles, taken together in double precision.
  template <int count>
  struct Sums
  {
    double values[count] = {};

    UNDINE_HOST_DEVICE
    double &
    operator[](const int k)
    {
      return values[k];
    }

    UNDINE_HOST_DEVICE
    double
    operator[](const int k) const
    {
      return values[k];
    }

    UNDINE_HOST_DEVICE
    Sums &
    operator+=(const Sums &other)
    {
      for (int k = 0; k < count; ++k)
        values[k] += other.values[k];
      return *this;
    }
  };
} // namespace undine::particles

#endif
