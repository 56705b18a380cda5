// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_volume_law_h
#define undine_particles_elasticity_volume_law_h

#include <undine/particles/math/vector.h>

namespace undine::particles
{
  /// What it costs to change the volume of an elastic body to J of that at rest:
  ///     W(J) = lambda/2 (J - 1)^2 + 2 M (b^4 / (3 J^3) - 2 b^2 / J - J + 8 b / 3),   M = lambda +
  ///     2 mu,
  /// the second term below b = 3/4 only, a barrier without which bodies collapse. Below `flat` the
  /// tension goes on linearly, also for inverted deformations.
  template <class Real>
  struct VolumeLaw
  {
    Real lambda;  ///< [Pa]
    Real modulus; ///< M [Pa]

    static constexpr Real onset = Real(0.75); ///< b [1]
    static constexpr Real flat  = Real(0.2);  ///< [1]

    /// [Pa]
    UNDINE_HOST_DEVICE
    Real
    energy(const Real J) const
    {
      Real result = lambda / 2 * (J - 1) * (J - 1);
      if (J < onset)
        {
          const Real j = maximum(J, flat), below = J - j;
          const Real ratio = onset / j;
          result += 2 * modulus * (onset * (ratio * (ratio * ratio / 3 - 2) + Real(8) / 3) - j) +
                    below * (barrier(j) + barrier_stiffness(j) * below / 2);
        }
      return result;
    }

    /// dW/dJ [Pa]
    UNDINE_HOST_DEVICE
    Real
    tension(const Real J) const
    {
      Real result = lambda * (J - 1);
      if (J < onset)
        {
          const Real j = maximum(J, flat);
          result += barrier(j) + barrier_stiffness(j) * (J - j);
        }
      return result;
    }

    /// d2W/dJ2 [Pa]
    UNDINE_HOST_DEVICE
    Real
    stiffness(const Real J) const
    {
      return lambda + (J < onset ? barrier_stiffness(maximum(J, flat)) : Real(0));
    }

  private:
    UNDINE_HOST_DEVICE
    Real
    barrier(const Real j) const
    {
      const Real ratio = onset / j, excess = ratio * ratio - 1;
      return -2 * modulus * excess * excess;
    }

    UNDINE_HOST_DEVICE
    Real
    barrier_stiffness(const Real j) const
    {
      const Real square = onset / j * (onset / j);
      return 8 * modulus * (square - 1) * square / j;
    }
  };
} // namespace undine::particles

#endif
