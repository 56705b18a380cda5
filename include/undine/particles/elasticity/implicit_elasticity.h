// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_implicit_elasticity_h
#define undine_particles_elasticity_implicit_elasticity_h

#include <undine/particles/elasticity/body_sums.h>
#include <undine/particles/elasticity/contact.h>
#include <undine/particles/elasticity/elastic_bodies.h>
#include <undine/particles/execution/sums.h>

namespace undine::particles
{
  /// Of a body: how its velocities change as a whole.
  template <int dim, class Real>
  struct RigidMotion
  {
    Vector<dim, Real> centre;   ///< of its particles [m]
    Vector<dim, Real> velocity; ///< there [m/s]
    Matrix<dim, Real> spin;     ///< antisymmetric [1/s]
  };

  /// Arrays that an implicit step needs, one entry a particle; of `rigid` one a body.
  template <int dim, class Real>
  struct ImplicitVectors
  {
    Vector<dim, Real>      *change, *residual, *direction, *product;
    Matrix<dim, Real>      *deformations, *stresses; ///< that belong to a direction
    RigidMotion<dim, Real> *rigid;
  };


  /// A step of backward Euler for stiff bodies, linearised:
  ///     (1 - h^2 A - h D) dv = h a + h^2 A v,   A = da/dx, of elasticity and contact, D = da/dv of
  ///     damping,
  /// by conjugate gradients in the scalar product of mass, for which A and D are symmetric and not
  /// positive. They begin with the rigid motion of each free body that is next to h a: it is what A
  /// does not feel, so that they would find it last, and forces on stiff bodies would be lost.
  template <int dim, class Real>
  struct ImplicitElasticity
  {
    Elasticity<dim, Real>      elasticity;
    Contact<dim, Real>         contact;
    ImplicitVectors<dim, Real> vectors;
    Real                       h; ///< [s]

    static constexpr double tolerance      = 1e-4; ///< of |residual| over the right-hand side's
    static constexpr int    max_iterations = 500;

    /// The change of velocities v, on which a = accelerations(i) acts; what is clamped stays.
    template <class Team, class Accelerations>
    UNDINE_HOST_DEVICE
    void
    step(Team &team, const Vector<dim, Real> *v, const Accelerations &accelerations) const
    {
      const int  n          = elasticity.bodies.n;
      const Real rate_share = 1 / h;
      differentiate(team, v, 0);
      const double enough =
        tolerance * tolerance * team.template sum<1>(n, [&](const int i, Sums<1> &sums) {
          vectors.residual[i] =
            is_clamped(i)
              ? Vector<dim, Real>::zero()
              : free_part(h * accelerations(i) + (h * h) * acceleration_change(i, v, 0), held(i));
          sums[0] += product(i, vectors.residual, vectors.residual);
        })[0];
      begin_rigidly(team);
      differentiate(team, vectors.change, rate_share);
      double square = team.template sum<1>(n, [&](const int i, Sums<1> &sums) {
        if (!is_clamped(i))
          vectors.residual[i] -= momentum_change(i, vectors.change);
        vectors.direction[i] = vectors.residual[i];
        sums[0] += product(i, vectors.residual, vectors.residual);
      })[0];
      for (int iteration = 0; iteration < max_iterations && square > enough; ++iteration)
        {
          differentiate(team, vectors.direction, rate_share);
          const double curvature = team.template sum<1>(n, [&](const int i, Sums<1> &sums) {
            vectors.product[i] =
              is_clamped(i) ? Vector<dim, Real>::zero() : momentum_change(i, vectors.direction);
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
    using Rigid = RigidMotion<dim, Real>;

    UNDINE_HOST_DEVICE
    unsigned char
    held(const int i) const
    {
      return elasticity.bodies.clamped[i];
    }

    /// In all directions?
    UNDINE_HOST_DEVICE
    bool
    is_clamped(const int i) const
    {
      return held(i) == all_directions<dim>;
    }

    UNDINE_HOST_DEVICE
    double
    product(const int i, const Vector<dim, Real> *a, const Vector<dim, Real> *b) const
    {
      return static_cast<double>(elasticity.material(i).density) * (a[i] * b[i]);
    }

    /// Changes of velocities as those of rigid bodies under the right-hand side; none in directions
    /// in which a body is clamped somewhere, and no spin of such bodies. In space the spin is exact
    /// for bodies that are round.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    begin_rigidly(Team &team) const
    {
      const auto &bodies = elasticity.bodies;
      for_each_body_sum<2 * dim + 1>(
        team,
        bodies,
        [&](const int i, Sums<2 * dim + 1> &sums) {
          for (int axis = 0; axis < dim; ++axis)
            {
              sums[axis] += bodies.points[i].x[axis];
              sums[dim + axis] += vectors.residual[i][axis];
            }
          sums[2 * dim] += 1;
        },
        [&](const int body, const Sums<2 * dim + 1> &sums) {
          Rigid rigid = {
            Vector<dim, Real>::zero(), Vector<dim, Real>::zero(), Matrix<dim, Real>::diagonal(0)};
          for (int axis = 0; axis < dim; ++axis)
            {
              rigid.centre[axis]   = static_cast<Real>(sums[axis] / sums[2 * dim]);
              rigid.velocity[axis] = static_cast<Real>(sums[dim + axis] / sums[2 * dim]);
            }
          rigid.velocity      = free_part(rigid.velocity, bodies.held[body]);
          vectors.rigid[body] = rigid;
        });
      team.sync();
      constexpr int planes = dim * (dim - 1) / 2;
      for_each_body_sum<planes + 1>(
        team,
        bodies,
        [&](const int i, Sums<planes + 1> &sums) {
          const auto r = bodies.points[i].x - vectors.rigid[bodies.bodies[i]].centre;
          const auto b = vectors.residual[i];
          for (int first = 0, plane = 0; first < dim; ++first)
            for (int second = first + 1; second < dim; ++second)
              sums[plane++] += static_cast<double>(b[first] * r[second] - b[second] * r[first]);
          sums[planes] += static_cast<double>(norm_square(r));
        },
        [&](const int body, const Sums<planes + 1> &sums) {
          auto &spin = vectors.rigid[body].spin;
          for (int first = 0, plane = 0; first < dim; ++first)
            for (int second = first + 1; second < dim; ++second)
              {
                const double rate   = sums[planes] > 0 && bodies.held[body] == 0
                                        ? dim / (2 * sums[planes]) * sums[plane]
                                        : 0.;
                spin[first][second] = static_cast<Real>(rate);
                spin[second][first] = static_cast<Real>(-rate);
                ++plane;
              }
        });
      team.sync();
      team.for_each(bodies.n, [&](const int i) {
        const Rigid rigid = vectors.rigid[bodies.bodies[i]];
        vectors.change[i] = rigid.velocity + rigid.spin * (bodies.points[i].x - rigid.centre);
      });
    }

    /// Of deformation gradients and stresses, in the direction u.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    differentiate(Team &team, const Vector<dim, Real> *u, const Real rate_share) const
    {
      team.sync();
      team.for_each(elasticity.bodies.n, [&](const int i) {
        elasticity.differentiate(i, u, rate_share, vectors.deformations, vectors.stresses);
      });
      team.sync();
    }

    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration_change(const int i, const Vector<dim, Real> *u, const Real rate_share) const
    {
      return elasticity.acceleration_change(
               i, u, rate_share, vectors.deformations, vectors.stresses) +
             contact.acceleration_change(i, u);
    }

    /// (1 - h^2 A - h D) u, without what is held.
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    momentum_change(const int i, const Vector<dim, Real> *u) const
    {
      return free_part((1 + h * elasticity.material(i).drag) * u[i] -
                         (h * h) * acceleration_change(i, u, 1 / h),
                       held(i));
    }
  };
} // namespace undine::particles

#endif
