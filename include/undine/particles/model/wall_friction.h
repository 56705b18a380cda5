// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_model_wall_friction_h
#define undine_particles_model_wall_friction_h

#include <undine/particles/math/vector.h>

namespace undine::particles
{
  /// Shear stress of a wall on the fluid next to it by the law of the wall: the speed u at the
  /// distance y and the friction velocity u* = sqrt(stress / density) are related by
  ///     u / u* = y u* / nu                                            where that is less,
  ///     u / u* = ln((y u* / nu) / (1 + 0.26 k u* / nu)) / 0.41 + 5.2  in turbulent flow,
  /// with the height k of sand grains [Schlichting, Boundary-Layer Theory, 17.1 and 17.2; the
  /// interpolation between smooth and rough walls is Colebrook's].
  template <class Real>
  struct WallFriction
  {
    Real viscosity; ///< nu, kinematic [m^2/s]; 0: no friction on walls
    Real roughness; ///< k [m]

    UNDINE_HOST_DEVICE
    bool
    acts() const
    {
      return viscosity > 0;
    }

    /// u* of the speed `u` [m/s] at the distance `y` [m] of the wall.
    UNDINE_HOST_DEVICE
    Real
    friction_velocity(const Real u, const Real y) const
    {
      const Real laminar = square_root(u * viscosity / y);
      Real       result  = maximum(laminar, u / 20);
      for (int k = 0; k < newton_steps; ++k)
        {
          const Real rough = 1 + Real(0.26) * roughness * result / viscosity;
          const Real ratio = log(maximum(y * result / viscosity / rough, Real(1))) / karman + shift;
          // of f = u* (u / u*) (u*) - u
          const Real slope = ratio + 1 / (karman * rough);
          result           = maximum(result - (result * ratio - u) / slope, laminar / 10);
        }
      return maximum(laminar, result);
    }

  private:
    static constexpr int  newton_steps = 4;
    static constexpr Real karman       = Real(0.41);
    static constexpr Real shift        = Real(5.2);
  };
} // namespace undine::particles

#endif
