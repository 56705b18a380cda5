// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_model_body_force_h
#define undine_particles_model_body_force_h

#include <undine/particles/math/vector.h>

namespace undine::particles
{
  /// Acceleration that acts everywhere: g - c (x - x_c).
  template <int dim, class Real>
  struct BodyForce
  {
    Vector<dim, Real> gravity;    ///< g [m/s^2]
    Real              attraction; ///< c [1/s^2]
    Vector<dim, Real> centre;     ///< x_c [m]

    /// [m/s^2]
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration(const Vector<dim, Real> &x) const
    {
      return gravity - attraction * (x - centre);
    }

    /// Potential energy per mass, zero at the centre and at the origin of its height [J/kg].
    UNDINE_HOST_DEVICE
    Real
    potential(const Vector<dim, Real> &x) const
    {
      return attraction / 2 * norm_square(x - centre) - gravity * x;
    }
  };
} // namespace undine::particles

#endif
