// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_elastic_state_h
#define undine_particles_elasticity_elastic_state_h

#include <undine/particles/math/matrix.h>

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


  /// The particles of all elastic bodies, by identity. The reference configuration and its
  /// neighbourhoods never change: forces are total Lagrangian.
  template <int dim, class Real>
  struct ElasticBodies
  {
    int n;

    const ReferencePoint<dim, Real> *reference;
    const int                       *bodies;    ///< number of the body
    const ElasticMaterial<Real>     *materials; ///< of the bodies
    const unsigned char             *clamped;   ///< does not move
    int                              capacity;  ///< of the list of neighbours in the reference
    const int                       *counts;
    const int                       *indices;
    const Matrix<dim, Real>         *inverse_moments; ///< A^{-1}, A = sum w X_ij X_ij^T [1/m^2]

    ElasticPoint<dim, Real> *points;
    Matrix<dim, Real>       *deformations; ///< F
    Matrix<dim, Real>       *rotations;    ///< R, last valid one
    Traction<dim, Real>     *tractions;

    const Real *carried; ///< of the bodies: mean pressure around them that elasticity carries [Pa]

    /// Of the particle's surface that does not touch its own body: its faces over rho V [m^2/kg in
    /// space], and their first moments about the centre over V [1].
    const Vector<dim, Real> *surfaces;
    const Matrix<dim, Real> *surface_moments;
  };
} // namespace undine::particles

#endif
