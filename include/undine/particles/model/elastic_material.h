// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_model_elastic_material_h
#define undine_particles_model_elastic_material_h

namespace undine::particles
{
  /// Bits of all directions of space.
  template <int dim>
  constexpr unsigned char all_directions = (1 << dim) - 1;

  /// The laws between strain and stress; those from the second on are finite elements', too.
  enum class Law : int
  {
    corotated,
    linear_elastic,
    saint_venant_kirchhoff,
    neo_hookean,
    nearly_incompressible_rubber
  };

  /// Of one elastic body.
  template <class Real>
  struct ElasticMaterial
  {
    Real lambda, mu; ///< Lame's parameters [Pa]
    Real density;    ///< [kg/m^3]
    Real hourglass;  ///< alpha: stiffness against motions that deformation gradients do not see [1]
    Real damping;    ///< zeta: share of critical damping of neighbours' relative motion [1]
    Real bulk_damping; ///< bulk viscosity over rho c_p l0, which damps sound [1]
    Real contact;   ///< stiffness of contact with walls and other bodies [N/m, in the plane per m]
    Real viscosity; ///< eta of P15, stress of the rate of strain over that of the strain [s]
    Real drag;      ///< alpha of P15 [1/s]
    Law  law;
  };
} // namespace undine::particles

#endif
