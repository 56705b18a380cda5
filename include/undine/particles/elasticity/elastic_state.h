// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_elastic_state_h
#define undine_particles_elasticity_elastic_state_h

#include <undine/particles/math/matrix.h>
#include <undine/particles/model/elastic_material.h>

namespace undine::particles
{
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


  /// Without the directions that are held.
  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Vector<dim, Real>
  free_part(Vector<dim, Real> v, const unsigned char held)
  {
    if (held != 0)
      for (int axis = 0; axis < dim; ++axis)
        if ((held >> axis & 1) != 0)
          v[axis] = 0;
    return v;
  }


  /// The particles of all elastic bodies, by identity. The reference configuration and its
  /// neighbourhoods never change: forces are total Lagrangian.
  template <int dim, class Real>
  struct ElasticBodies
  {
    int n;

    const ReferencePoint<dim, Real> *reference;
    const int                       *bodies;    ///< number of the body
    const ElasticMaterial<Real>     *materials; ///< of the bodies
    int                              n_bodies;
    const int                       *members; ///< by body
    const int                       *starts; ///< of the bodies' particles in `members`, and its end
    const unsigned char             *clamped;  ///< directions in which it does not move, bits
    const unsigned char             *held;     ///< of the bodies: those of any of their particles
    int                              capacity; ///< of the list of neighbours in the reference
    const int                       *counts;
    const int                       *indices;
    const Matrix<dim, Real>         *inverse_moments; ///< A^{-1}, A = sum w X_ij X_ij^T [1/m^2]

    ElasticPoint<dim, Real> *points;
    Matrix<dim, Real>       *deformations; ///< F
    Matrix<dim, Real>       *rotations;    ///< R, last valid one
    Traction<dim, Real>     *tractions;

    const Real *carried; ///< of the bodies: mean pressure around them that elasticity carries [Pa]
  };
} // namespace undine::particles

#endif
