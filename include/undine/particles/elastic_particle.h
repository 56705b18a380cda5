// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elastic_particle_h
#define undine_particles_elastic_particle_h

#include <undine/particles/matrix.h>

namespace undine::particles
{
  /// Of one elastic body.
  template <class Real>
  struct ElasticMaterial
  {
    Real lambda, mu; ///< Lame's parameters [Pa]
    Real density;    ///< [kg/m^3]
    Real hourglass;  ///< alpha: stiffness against motions that deformation gradients do not see [1]
    Real damping;    ///< zeta: share of critical damping of neighbours' relative motion [1]
    Real bulk_damping; ///< bulk viscosity over rho c_p l0, which damps sound [1]
    Real contact; ///< stiffness of contact with walls and other bodies [N/m, in the plane per m]
  };

  /// Words that the device reads at once. @{

  /// Of the reference configuration.
  template <int dim, class Real>
  struct alignas(4 * sizeof(Real)) ReferencePoint
  {
    Vector<dim, Real> x;            ///< X [m]
    Real              inverse_mean; ///< 1 / a, a = tr(A) / dim [1/m^2]
  };

  template <int dim, class Real>
  struct alignas(4 * sizeof(Real)) ElasticPoint
  {
    Vector<dim, Real> x; ///< [m]
    Vector<dim, Real> v; ///< [m/s]
  };

  /// A particle's part in the force of its bonds, T = P A^{-1} - (2 alpha mu / a) F [Pa/m^2], P of
  /// first Piola and Kirchhoff.
  template <int dim, class Real>
  struct alignas(4 * sizeof(Real)) Traction
  {
    Matrix<dim, Real> matrix;
  };
  /// @}
} // namespace undine::particles

#endif
