// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_execution_lanes_h
#define undine_particles_execution_lanes_h

#include <undine/particles/math/matrix.h>

namespace undine::particles
{
  /// Those who share the work on one particle, as one of them sees it: here it is alone.
  /// DeviceLanes in cuda/ has the same interface for threads of a warp.
  struct OneLane
  {
    UNDINE_HOST_DEVICE
    static int
    rank()
    {
      return 0;
    }

    UNDINE_HOST_DEVICE
    static constexpr int
    count()
    {
      return 1;
    }

    /// Of the values of all lanes, for all lanes.
    template <class T>
    UNDINE_HOST_DEVICE
    static T
    sum(const T &value)
    {
      return value;
    }

    /// A bit for each lane that says yes.
    UNDINE_HOST_DEVICE
    static unsigned int
    ballot(const bool yes)
    {
      return yes ? 1 : 0;
    }

    /// The bits of a ballot, of all lanes and of those before this one. @{
    UNDINE_HOST_DEVICE
    static int
    votes(const unsigned int ballot)
    {
      return static_cast<int>(ballot);
    }

    UNDINE_HOST_DEVICE
    static int
    votes_before(const unsigned int)
    {
      return 0;
    }
    /// @}
  };
} // namespace undine::particles

#endif
