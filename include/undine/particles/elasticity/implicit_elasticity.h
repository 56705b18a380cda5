// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_implicit_elasticity_h
#define undine_particles_elasticity_implicit_elasticity_h

#include <undine/particles/elasticity/elastic_bodies.h>
#include <undine/particles/execution/sums.h>

namespace undine::particles
{
  /// Arrays that an implicit step needs, one entry a particle.
  template <int dim, class Real>
  struct ImplicitVectors
  {
    Vector<dim, Real> *change, *residual, *direction, *product;
    Matrix<dim, Real> *deformations, *stresses; ///< that belong to a direction
  };


  /// A step of backward Euler for stiff bodies, linearised with the rotations kept:
  ///     (1 - h^2 A) dv = h a + h^2 A v,   A = da/dx at fixed R,
  /// by conjugate gradients in the scalar product of mass, for which A is symmetric and not
  /// positive.
  template <int dim, class Real>
  struct ImplicitElasticity
  {
    Elasticity<dim, Real>      elasticity;
    ImplicitVectors<dim, Real> vectors;
    Real                       h; ///< [s]

    static constexpr double tolerance      = 1e-4; ///< of |residual| over the right-hand side's
    static constexpr int    max_iterations = 200;

    /// The change of velocities v, on which a = accelerations(i) acts; clamped particles stay.
    template <class Team, class Accelerations>
    UNDINE_HOST_DEVICE
    void
    step(Team &team, const Vector<dim, Real> *v, const Accelerations &accelerations) const
    {
      const int n = elasticity.bodies.n;
      differentiate(team, v);
      double       square = team.template sum<1>(n, [&](const int i, Sums<1> &sums) {
        vectors.change[i]    = Vector<dim, Real>::zero();
        vectors.residual[i]  = is_clamped(i)
                                       ? Vector<dim, Real>::zero()
                                       : h * accelerations(i) + (h * h) * acceleration_change(i, v);
        vectors.direction[i] = vectors.residual[i];
        sums[0] += product(i, vectors.residual, vectors.residual);
      })[0];
      const double enough = tolerance * tolerance * square;
      for (int iteration = 0; iteration < max_iterations && square > enough; ++iteration)
        {
          differentiate(team, vectors.direction);
          const double curvature = team.template sum<1>(n, [&](const int i, Sums<1> &sums) {
            vectors.product[i] =
              is_clamped(i)
                ? Vector<dim, Real>::zero()
                : vectors.direction[i] - (h * h) * acceleration_change(i, vectors.direction);
            sums[0] += product(i, vectors.direction, vectors.product);
          })[0];
          const Real   length    = static_cast<Real>(square / curvature);
          const double next      = team.template sum<1>(n, [&](const int i, Sums<1> &sums) {
            vectors.change[i] += length * vectors.direction[i];
            vectors.residual[i] -= length * vectors.product[i];
            sums[0] += product(i, vectors.residual, vectors.residual);
          })[0];
          const Real   turn      = static_cast<Real>(next / square);
          square                 = next;
          team.for_each(n, [&](const int i) {
            vectors.direction[i] = vectors.residual[i] + turn * vectors.direction[i];
          });
          team.sync();
        }
    }

  private:
    UNDINE_HOST_DEVICE
    bool
    is_clamped(const int i) const
    {
      return elasticity.bodies.clamped[i] != 0;
    }

    UNDINE_HOST_DEVICE
    double
    product(const int i, const Vector<dim, Real> *a, const Vector<dim, Real> *b) const
    {
      return static_cast<double>(elasticity.material(i).density) * (a[i] * b[i]);
    }

    /// Of deformation gradients and stresses, in the direction u.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    differentiate(Team &team, const Vector<dim, Real> *u) const
    {
      team.sync();
      team.for_each(elasticity.bodies.n, [&](const int i) {
        elasticity.differentiate(i, u, vectors.deformations, vectors.stresses);
      });
      team.sync();
    }

    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration_change(const int i, const Vector<dim, Real> *u) const
    {
      return elasticity.acceleration_change(i, u, vectors.deformations, vectors.stresses);
    }
  };
} // namespace undine::particles

#endif
