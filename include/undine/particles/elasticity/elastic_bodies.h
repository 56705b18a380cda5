// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_elastic_bodies_h
#define undine_particles_elasticity_elastic_bodies_h

#include <undine/particles/elasticity/elastic_state.h>
#include <undine/particles/elasticity/volume_law.h>
#include <undine/particles/execution/lanes.h>
#include <undine/particles/math/rotation.h>
#include <undine/particles/model/cell_grid.h>
#include <undine/particles/neighbours/neighbours.h>

namespace undine::particles
{
  /// Fixed corotated elasticity of particles, derived from one energy (P9), so that momentum and
  /// angular momentum are exact:
  ///     W = sum_i V (mu |F_i - R_i|^2 + U(det F_i))
  ///       + sum_ij alpha mu V w_ij |x_ij - F_i X_ij|^2 / a_i,     U: VolumeLaw
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
    bool                     is_damped = true; ///< else without viscous forces

    /// One neighbour j of a particle i in the reference.
    struct Bond
    {
      int               j;
      Vector<dim, Real> X;            ///< X_ij [m]
      Vector<dim, Real> x, v;         ///< at present, v_j - v_i [m/s]
      Real              weight;       ///< w_ij [1]
      Real              inverse_mean; ///< 1 / a_j
    };

    /// The k-th bond of i as the reference knows it; after the last one of i with itself, with the
    /// weight zero.
    UNDINE_HOST_DEVICE
    Bond
    reference_bond(const int i, const int k) const
    {
      const int j = bodies.indices[list_slot(i, minimum(k, bodies.capacity - 1), bodies.capacity)];
      return bond_to(j, bodies.reference[i].x, bodies.reference[j], k < bodies.counts[i]);
    }

    /// With the points of both ends.
    UNDINE_HOST_DEVICE
    Bond
    at_present(Bond                           bond,
               const ElasticPoint<dim, Real> &own,
               const Vector<dim, Real>       &x,
               const Vector<dim, Real>       &v) const
    {
      bond.x = grid.difference(x, own.x);
      bond.v = v - own.v;
      return bond;
    }

    /// f(bond) for this lane's share of the bonds of i, and some with the weight zero. The list is
    /// filled up with such ones, so that it can be read before it is known how many there are.
    template <class Lanes, class Function>
    UNDINE_HOST_DEVICE
    void
    for_each_bond(const int i, const Lanes &lanes, const Function &f) const
    {
      constexpr int           together = 4; // on the way at the same time
      const Vector<dim, Real> X        = bodies.reference[i].x;
      const auto              point    = bodies.points[i];
      const int               count    = bodies.counts[i];
      int                     first    = lanes.rank();
      do
        {
          int                       j[together];
          ReferencePoint<dim, Real> reference[together];
          ElasticPoint<dim, Real>   other[together];
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            j[k] = bodies.indices[list_slot(
              i, minimum(first + k * lanes.count(), bodies.capacity - 1), bodies.capacity)];
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            {
              reference[k] = bodies.reference[j[k]];
              other[k]     = bodies.points[j[k]];
            }
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            {
              const bool exists = first + k * lanes.count() < count;
              f(at_present(bond_to(j[k], X, reference[k], exists), point, other[k].x, other[k].v));
            }
          first += together * lanes.count();
        }
      while (first < count);
    }

    UNDINE_HOST_DEVICE
    const ElasticMaterial<Real> &
    material(const int i) const
    {
      return bodies.materials[bodies.bodies[i]];
    }

    /// What a particle is besides its bonds; constant in a sub-step.
    struct Particle
    {
      ElasticMaterial<Real> material;
      Real                  inverse_mean; ///< 1 / a_i
      Real                  carried;      ///< as in ElasticBodies [Pa]
      Matrix<dim, Real>     inverse_moment;
    };

    /// Of one particle at present.
    struct Deformation
    {
      Matrix<dim, Real> F, R, T; ///< gradient, rotation, traction
    };

    UNDINE_HOST_DEVICE
    Particle
    particle(const int i) const
    {
      const int body = bodies.bodies[i];
      return {
        bodies.materials[body], inverse_mean(i), bodies.carried[body], bodies.inverse_moments[i]};
    }

    /// Bonds are given as for_each(f), which calls f(bond) for this lane's share.
    template <class Lanes, class Bonds>
    UNDINE_HOST_DEVICE
    Deformation
    deformation(const Particle          &particle,
                const Matrix<dim, Real> &last_rotation,
                const Lanes             &lanes,
                const Bonds             &for_each) const
    {
      auto moment = Matrix<dim, Real>::diagonal(0), rate = moment;
      for_each([&](const Bond &bond) {
        moment.add_outer_product(bond.weight, bond.x, bond.X);
        rate.add_outer_product(bond.weight, bond.v, bond.X);
      });
      const auto &properties = particle.material;
      const Real  stiffness  = 2 * properties.hourglass * properties.mu * particle.inverse_mean;
      const auto  F          = lanes.sum(moment) * particle.inverse_moment;
      const auto  R          = rotation_of(F, last_rotation);
      auto        T =
        stress(properties, F, R, lanes.sum(rate) * particle.inverse_moment, particle.carried) *
        particle.inverse_moment;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          T[a][b] -= stiffness * F[a][b];
      return {F, R, T};
    }

    /// The acceleration by elasticity, damping and the carried pressure [m/s^2]; T is the
    /// particle's own traction. for_each(f) calls f(bond, traction of its other end).
    template <class Lanes, class Bonds>
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration(const Particle          &particle,
                 const Matrix<dim, Real> &T,
                 const Lanes             &lanes,
                 const Bonds             &for_each) const
    {
      const auto &properties = particle.material;
      const Real  stiffness  = 2 * properties.hourglass * properties.mu;
      const Real  rate =
        is_damped ? sound_impedance(properties) * properties.damping / (8 * spacing) : Real(0);
      auto force = Vector<dim, Real>::zero();
      for_each([&](const Bond &bond, const Matrix<dim, Real> &other) {
        force += bond.weight * (T * bond.X + other * bond.X);
        force += (bond.weight * (stiffness * (particle.inverse_mean + bond.inverse_mean) +
                                 rate * (bond.v * bond.x) / positive(norm_square(bond.x)))) *
                 bond.x;
      });
      return (1 / properties.density) * lanes.sum(force);
    }

    /// F, R and T at the present places.
    template <class Lanes>
    UNDINE_HOST_DEVICE
    void
    deform(const int i, const Lanes &lanes) const
    {
      const auto own  = particle(i);
      const auto last = bodies.rotations[i];
      const auto now =
        deformation(own, last, lanes, [&](const auto &f) { for_each_bond(i, lanes, f); });
      if (lanes.rank() != 0)
        return;
      bodies.deformations[i]     = now.F;
      bodies.rotations[i]        = now.R;
      bodies.tractions[i].matrix = now.T;
    }

    /// As above, after deform() of all.
    template <class Lanes>
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration(const int i, const Lanes &lanes) const
    {
      return acceleration(particle(i), bodies.tractions[i].matrix, lanes, [&](const auto &f) {
        for_each_bond(
          i, lanes, [&](const Bond &bond) { f(bond, bodies.tractions[bond.j].matrix); });
      });
    }

    /// Changes of F and of P A^{-1} with places that move along u; the cofactors of F are held, and
    /// R turns as it does where F is a rotation: rigid motions change no stress.
    UNDINE_HOST_DEVICE
    void
    differentiate(const int                i,
                  const Vector<dim, Real> *u,
                  Matrix<dim, Real>       *F_changes,
                  Matrix<dim, Real>       *stress_changes) const
    {
      auto moment = Matrix<dim, Real>::diagonal(0);
      for_each_bond(i, OneLane(), [&](const Bond &bond) {
        moment.add_outer_product(bond.weight, u[bond.j] - u[i], bond.X);
      });
      const auto       &properties = material(i);
      const auto        F          = moment * bodies.inverse_moments[i];
      const auto        C          = cofactors(bodies.deformations[i]);
      const Real        J          = determinant(bodies.deformations[i]);
      const Real        pull       = volume_law(properties).stiffness(J) * double_contraction(C, F);
      const auto        stretch    = without_turn(bodies.rotations[i], F);
      Matrix<dim, Real> stress;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          stress[a][b] = 2 * properties.mu * stretch[a][b] + pull * C[a][b];
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
      const Real  a_i       = inverse_mean(i);
      auto        force     = Vector<dim, Real>::zero();
      for_each_bond(i, OneLane(), [&](const Bond &bond) {
        const auto u_ij = u[bond.j] - u[i];
        force += bond.weight * (stress_i * bond.X + stress_changes[bond.j] * bond.X);
        force +=
          (bond.weight * stiffness) *
          (a_i * (u_ij - F_i * bond.X) + bond.inverse_mean * (u_ij - F_changes[bond.j] * bond.X));
      });
      return (1 / properties.density) * force;
    }

    /// The square of the speed of pressure waves where they are fastest [m^2/s^2].
    UNDINE_HOST_DEVICE
    static Real
    sound_square(const ElasticMaterial<Real> &properties, const Matrix<dim, Real> &F)
    {
      const auto C      = cofactors(F);
      Real       square = 0; // of |C C^T - 1|, which bounds the change of the largest stretch
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          {
            Real entry = a == b ? Real(-1) : Real(0);
            for (int c = 0; c < dim; ++c)
              entry += C[a][c] * C[b][c];
            square += entry * entry;
          }
      return (2 * properties.mu +
              volume_law(properties).stiffness(determinant(F)) * (1 + square_root(square))) /
             properties.density;
    }

    /// U'(det F) of a particle [Pa], after deform().
    UNDINE_HOST_DEVICE
    Real
    volume_tension(const int i) const
    {
      return volume_law(material(i)).tension(determinant(bodies.deformations[i]));
    }

    /// Of a small change of the volume of what a particle belongs to [1/Pa].
    UNDINE_HOST_DEVICE
    Real
    compressibility(const int i) const
    {
      const auto &properties = material(i);
      return 1 / (properties.lambda + 2 * properties.mu / dim);
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
      Real bonds = 0;
      for_each_bond(i, OneLane(), [&](const Bond &bond) {
        bonds += bond.weight * norm_square(bond.x - F * bond.X);
      });
      return properties.mu * square + volume_law(properties).energy(determinant(F)) +
             properties.hourglass * properties.mu * inverse_mean(i) * bonds;
    }

  private:
    UNDINE_HOST_DEVICE
    Bond
    bond_to(const int                        j,
            const Vector<dim, Real>         &X,
            const ReferencePoint<dim, Real> &other,
            const bool                       exists) const
    {
      const auto X_ij   = other.x - X;
      const Real weight = reach * inverse_square_root(positive(norm_square(X_ij))) - 1;
      return {j,
              X_ij,
              Vector<dim, Real>::zero(),
              Vector<dim, Real>::zero(),
              exists ? weight : Real(0),
              other.inverse_mean};
    }

    /// The part of a change of F that is no rotation, R sym(R^T dF).
    UNDINE_HOST_DEVICE
    static Matrix<dim, Real>
    without_turn(const Matrix<dim, Real> &R, const Matrix<dim, Real> &change)
    {
      auto in_body = Matrix<dim, Real>::diagonal(0);
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          for (int c = 0; c < dim; ++c)
            {
              const Real entry = R[c][a] * change[c][b] / 2;
              in_body[a][b] += entry;
              in_body[b][a] += entry;
            }
      return R * in_body;
    }

    /// Not zero, as it would be of a particle with itself, with which lists are filled up.
    UNDINE_HOST_DEVICE
    static Real
    positive(const Real square)
    {
      return maximum(square, Real(1e-30));
    }

    /// 1 / a_i
    UNDINE_HOST_DEVICE
    Real
    inverse_mean(const int i) const
    {
      return bodies.reference[i].inverse_mean;
    }

    UNDINE_HOST_DEVICE
    static VolumeLaw<Real>
    volume_law(const ElasticMaterial<Real> &properties)
    {
      return {properties.lambda, properties.lambda + 2 * properties.mu};
    }

    /// rho c_p, the scale of damping [kg/m^2 s].
    UNDINE_HOST_DEVICE
    static Real
    sound_impedance(const ElasticMaterial<Real> &properties)
    {
      return square_root((properties.lambda + 2 * properties.mu) * properties.density);
    }

    /// Of first Piola and Kirchhoff, P = 2 mu (F - R) + U'(det F) cof(F) [Pa] (P9), with bulk
    /// viscosity and with the pressure that the body carries (P10).
    UNDINE_HOST_DEVICE
    Matrix<dim, Real>
    stress(const ElasticMaterial<Real> &properties,
           const Matrix<dim, Real>     &F,
           const Matrix<dim, Real>     &R,
           const Matrix<dim, Real>     &F_rate,
           const Real                   carried) const
    {
      const Real bulk_viscosity =
        is_damped ? properties.bulk_damping * sound_impedance(properties) * spacing : Real(0);
      const auto C    = cofactors(F); // dJ/dF
      const Real pull = volume_law(properties).tension(determinant(F)) + carried +
                        bulk_viscosity * double_contraction(C, F_rate) /
                          maximum(Real(1), double_contraction(C, C) / dim);
      Matrix<dim, Real> result;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          result[a][b] = 2 * properties.mu * (F[a][b] - R[a][b]) + pull * C[a][b];
      return result;
    }
  };
} // namespace undine::particles

#endif
