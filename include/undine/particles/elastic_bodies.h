// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elastic_bodies_h
#define undine_particles_elastic_bodies_h

#include <undine/particles/cell_grid.h>
#include <undine/particles/matrix.h>
#include <undine/particles/neighbours.h>

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

  /// The particles of all elastic bodies, by identity. The reference configuration and its
  /// neighbourhoods never change: forces are total Lagrangian.
  template <int dim, class Real>
  struct ElasticBodies
  {
    int n;

    const Vector<dim, Real>     *reference; ///< X [m]
    const int                   *bodies;    ///< number of the body
    const ElasticMaterial<Real> *materials; ///< of the bodies
    const unsigned char         *held;      ///< does not move
    int                          capacity;  ///< of the list of neighbours in the reference
    const int                   *counts;
    const int                   *indices;
    const Matrix<dim, Real>     *inverse_moments; ///< A^{-1}, A = sum w X_ij X_ij^T [1/m^2]
    const Real                  *inverse_means;   ///< 1 / a, a = tr(A) / dim [1/m^2]

    Vector<dim, Real> *x, *v;
    Matrix<dim, Real> *deformations; ///< F
    Matrix<dim, Real> *rotations;    ///< R, last valid one
    Matrix<dim, Real> *stresses;     ///< P A^{-1} [Pa/m^2], P of first Piola and Kirchhoff

    const Real *carried; ///< of the bodies: mean pressure around them that elasticity carries [Pa]

    /// Of the particle's surface that does not touch its own body: its faces over rho V [m^2/kg in
    /// space], and their first moments about the centre over V [1].
    const Vector<dim, Real> *surfaces;
    const Matrix<dim, Real> *surface_moments;
  };

  /// Corotated linear elasticity of particles, derived from one energy, so that momentum and
  /// angular momentum are exact:
  ///     W = sum_i V (mu |F_i - R_i|^2 + lambda/2 tr(R_i^T F_i - I)^2)
  ///       + sum_ij alpha mu V w_ij |x_ij - F_i X_ij|^2 / a_i,
  ///     F_i = (sum_j w x_ij X_ij^T) A_i^{-1},  R_i = rotation of F_i,  a_i = tr(A_i) / dim.
  /// In the inside of a lattice alpha = 1 is the particle method's usual sum over rotated bonds
  /// (the source's equation 6 without its local rotation).
  template <int dim, class Real>
  struct Elasticity
  {
    CellGrid<dim, Real>      grid;
    Real                     spacing; ///< [m]
    Real                     reach;   ///< [m]
    ElasticBodies<dim, Real> bodies;
    bool                     is_damped; ///< else without viscous forces

    /// f(j, X_ij, x_ij, w_ij) for all neighbours in the reference.
    template <class Function>
    UNDINE_HOST_DEVICE
    void
    for_each_bond(const int i, const Function &f) const
    {
      constexpr int           together = 4; // on the way at the same time
      const Vector<dim, Real> X = bodies.reference[i], x = bodies.x[i];
      const int               count = bodies.counts[i];
      for (int first = 0; first < count; first += together)
        {
          int               j[together];
          Vector<dim, Real> X_j[together], x_j[together];
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            j[k] = bodies.indices[list_slot(i, minimum(first + k, count - 1), bodies.capacity)];
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            {
              X_j[k] = bodies.reference[j[k]];
              x_j[k] = bodies.x[j[k]];
            }
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            if (first + k < count)
              {
                const auto X_ij = X_j[k] - X;
                f(j[k],
                  X_ij,
                  grid.difference(x_j[k], x),
                  reach * inverse_square_root(norm_square(X_ij)) - 1);
              }
        }
    }

    UNDINE_HOST_DEVICE
    const ElasticMaterial<Real> &
    material(const int i) const
    {
      return bodies.materials[bodies.bodies[i]];
    }

    /// F, R and P A^{-1} at the present places.
    UNDINE_HOST_DEVICE
    void
    deform(const int i) const
    {
      auto moment = Matrix<dim, Real>::diagonal(0), rate = moment;
      for_each_bond(
        i,
        [&](
          const int j, const Vector<dim, Real> &X_ij, const Vector<dim, Real> &x_ij, const Real w) {
          moment.add_outer_product(w, x_ij, X_ij);
          rate.add_outer_product(w, bodies.v[j] - bodies.v[i], X_ij);
        });
      const auto F           = moment * bodies.inverse_moments[i];
      bodies.deformations[i] = F;
      bodies.rotations[i]    = rotation_of(F, bodies.rotations[i]);
      bodies.stresses[i] = stress(i, rate * bodies.inverse_moments[i]) * bodies.inverse_moments[i];
    }

    /// The acceleration by elasticity, damping and the carried pressure [m/s^2], after deform() of
    /// all.
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration(const int i) const
    {
      const auto &properties = material(i);
      const auto  F_i = bodies.deformations[i], stress_i = bodies.stresses[i];
      const Real  stiffness = 2 * properties.hourglass * properties.mu;
      const Real  a_i       = bodies.inverse_means[i];
      const Real  rate =
        is_damped ? sound_impedance(i) * properties.damping / (8 * spacing) : Real(0);
      auto force = Vector<dim, Real>::zero();
      for_each_bond(
        i,
        [&](
          const int j, const Vector<dim, Real> &X_ij, const Vector<dim, Real> &x_ij, const Real w) {
          force += w * (stress_i * X_ij + bodies.stresses[j] * X_ij);
          force +=
            (w * stiffness) * (a_i * (x_ij - F_i * X_ij) +
                               bodies.inverse_means[j] * (x_ij - bodies.deformations[j] * X_ij));
          if (rate > 0)
            force += (w * rate * ((bodies.v[j] - bodies.v[i]) * x_ij) / norm_square(x_ij)) * x_ij;
        });
      return (1 / properties.density) * force -
             bodies.carried[bodies.bodies[i]] * bodies.surfaces[i];
    }

    /// Changes of F and of P A^{-1} with places that move along u, rotations held.
    UNDINE_HOST_DEVICE
    void
    differentiate(const int                i,
                  const Vector<dim, Real> *u,
                  Matrix<dim, Real>       *F_changes,
                  Matrix<dim, Real>       *stress_changes) const
    {
      auto moment = Matrix<dim, Real>::diagonal(0);
      for_each_bond(
        i,
        [&](const int j, const Vector<dim, Real> &X_ij, const Vector<dim, Real> &, const Real w) {
          moment.add_outer_product(w, u[j] - u[i], X_ij);
        });
      const auto       &properties = material(i);
      const auto        F = moment * bodies.inverse_moments[i], R = bodies.rotations[i];
      const Real        pull = properties.lambda * double_contraction(R, F);
      Matrix<dim, Real> stress;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          stress[a][b] = 2 * properties.mu * F[a][b] + pull * R[a][b];
      F_changes[i]      = F;
      stress_changes[i] = stress * bodies.inverse_moments[i];
    }

    /// Change of the elastic acceleration that belongs to them [1/s^2 times that of u].
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration_change(const int                i,
                        const Vector<dim, Real> *u,
                        const Matrix<dim, Real> *F_changes,
                        const Matrix<dim, Real> *stress_changes) const
    {
      const auto &properties = material(i);
      const auto  F_i = F_changes[i], stress_i = stress_changes[i];
      const Real  stiffness = 2 * properties.hourglass * properties.mu;
      const Real  a_i       = bodies.inverse_means[i];
      auto        force     = Vector<dim, Real>::zero();
      for_each_bond(
        i,
        [&](const int j, const Vector<dim, Real> &X_ij, const Vector<dim, Real> &, const Real w) {
          const auto u_ij = u[j] - u[i];
          force += w * (stress_i * X_ij + stress_changes[j] * X_ij);
          force += (w * stiffness) * (a_i * (u_ij - F_i * X_ij) +
                                      bodies.inverse_means[j] * (u_ij - F_changes[j] * X_ij));
        });
      return (1 / properties.density) * force;
    }

    /// Density of elastic energy at a particle [J/m^dim], after deform() of all.
    UNDINE_HOST_DEVICE
    Real
    energy_density(const int i) const
    {
      const auto &properties = material(i);
      const auto  F = bodies.deformations[i], R = bodies.rotations[i];
      Real        square = 0;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          square += (F[a][b] - R[a][b]) * (F[a][b] - R[a][b]);
      const Real strain = double_contraction(R, F) - dim;
      Real       bonds  = 0;
      for_each_bond(
        i,
        [&](const int, const Vector<dim, Real> &X_ij, const Vector<dim, Real> &x_ij, const Real w) {
          bonds += w * norm_square(x_ij - F * X_ij);
        });
      const Real excess = excess_squeeze(strain);
      return properties.mu * square + properties.lambda / 2 * strain * strain -
             resistance(properties, excess) * excess / 3 +
             properties.hourglass * properties.mu * bodies.inverse_means[i] * bonds;
    }

  private:
    /// Linear elasticity lets a body collapse: once a quarter of its volume is gone, squeezing it
    /// meets a growing resistance, a pressure of 2 (lambda + 2 mu) e^2 where e = s + 1/4 < 0 [Pa].
    UNDINE_HOST_DEVICE
    static Real
    resistance(const ElasticMaterial<Real> &properties, const Real excess)
    {
      return 2 * (properties.lambda + 2 * properties.mu) * excess * excess;
    }

    UNDINE_HOST_DEVICE
    static Real
    excess_squeeze(const Real strain)
    {
      return minimum(strain + Real(0.25), Real(0));
    }

    /// rho c_p, the scale of damping [kg/m^2 s].
    UNDINE_HOST_DEVICE
    Real
    sound_impedance(const int i) const
    {
      return sqrt((material(i).lambda + 2 * material(i).mu) * material(i).density);
    }

    /// Of first Piola and Kirchhoff, P = 2 mu (F - R) + lambda tr(R^T F - I) R [Pa], with bulk
    /// viscosity and what the carried pressure adds because it acts on the surface and not at
    /// centres of particles.
    UNDINE_HOST_DEVICE
    Matrix<dim, Real>
    stress(const int i, const Matrix<dim, Real> &F_rate) const
    {
      const auto &properties = material(i);
      const auto  F = bodies.deformations[i], R = bodies.rotations[i];
      const auto  surface = bodies.surface_moments[i] * R;
      const Real  carried = bodies.carried[bodies.bodies[i]];
      const Real  bulk_viscosity =
        is_damped ? properties.bulk_damping * sound_impedance(i) * spacing : Real(0);
      const Real strain = double_contraction(R, F) - dim; // tr(R^T F - I)
      const Real pull   = properties.lambda * strain -
                        resistance(properties, excess_squeeze(strain)) +
                        bulk_viscosity * double_contraction(R, F_rate);
      Matrix<dim, Real> result;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          result[a][b] =
            2 * properties.mu * (F[a][b] - R[a][b]) + pull * R[a][b] + carried * surface[a][b];
      return result;
    }
  };
} // namespace undine::particles

#endif
