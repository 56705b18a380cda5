// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_elastic_bodies_h
#define undine_particles_elasticity_elastic_bodies_h

#include <undine/particles/elasticity/elastic_law.h>
#include <undine/particles/elasticity/elastic_state.h>
#include <undine/particles/execution/lanes.h>
#include <undine/particles/model/cell_grid.h>
#include <undine/particles/neighbours/neighbours.h>

namespace undine::particles
{
  /// Elasticity of particles, derived from one energy (P9), so that momentum and, but for the
  /// linear law, angular momentum are exact:
  ///     W = sum_i V W(F_i) + sum_ij alpha mu V w_ij |x_ij - F_i X_ij|^2 / a_i,   W(F): ElasticLaw
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
    bool                     is_damped = true; ///< else without numerical viscosity

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
      const auto  R          = law(properties).rotation(F, last_rotation);
      const auto  F_rate     = lanes.sum(rate) * particle.inverse_moment;
      auto        T = stress(properties, F, R, F_rate, particle.carried) * particle.inverse_moment;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          T[a][b] -= stiffness * F[a][b];
      if (properties.viscosity > 0)
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            T[a][b] -= stiffness * properties.viscosity * F_rate[a][b];
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
        if (properties.viscosity > 0)
          force += (bond.weight * stiffness * properties.viscosity *
                    (particle.inverse_mean + bond.inverse_mean)) *
                   bond.v;
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

    /// Changes of F and of P A^{-1} with places that move along u, as in ElasticLaw, and, times
    /// `rate_share` [1/s], with velocities that change by u.
    UNDINE_HOST_DEVICE
    void
    differentiate(const int                i,
                  const Vector<dim, Real> *u,
                  const Real               rate_share,
                  Matrix<dim, Real>       *F_changes,
                  Matrix<dim, Real>       *stress_changes) const
    {
      auto moment = Matrix<dim, Real>::diagonal(0);
      for_each_bond(i, OneLane(), [&](const Bond &bond) {
        moment.add_outer_product(bond.weight, u[bond.j] - u[i], bond.X);
      });
      const auto &properties = material(i);
      const auto  F          = moment * bodies.inverse_moments[i];
      const auto  now        = bodies.deformations[i];
      auto        stress     = law(properties).stress_change(now, bodies.rotations[i], F);
      if (rate_share * properties.viscosity > 0)
        add(stress, rate_share * properties.viscosity, law(properties).strain_rate_stress(now, F));
      F_changes[i]      = F;
      stress_changes[i] = stress * bodies.inverse_moments[i];
    }

    /// Change of the elastic acceleration that belongs to them [1/s^2 times that of u].
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration_change(const int                i,
                        const Vector<dim, Real> *u,
                        const Real               rate_share,
                        const Matrix<dim, Real> *F_changes,
                        const Matrix<dim, Real> *stress_changes) const
    {
      const auto &properties = material(i);
      const auto  F_i = F_changes[i], stress_i = stress_changes[i];
      const Real  stiffness =
        2 * properties.hourglass * properties.mu * (1 + rate_share * properties.viscosity);
      const Real a_i   = inverse_mean(i);
      auto       force = Vector<dim, Real>::zero();
      for_each_bond(i, OneLane(), [&](const Bond &bond) {
        const auto u_ij = u[bond.j] - u[i];
        force += bond.weight * (stress_i * bond.X + stress_changes[bond.j] * bond.X);
        force +=
          (bond.weight * stiffness) *
          (a_i * (u_ij - F_i * bond.X) + bond.inverse_mean * (u_ij - F_changes[bond.j] * bond.X));
      });
      return (1 / properties.density) * force;
    }

    /// What bears a pressure around a particle [Pa], after deform().
    UNDINE_HOST_DEVICE
    Real
    volume_tension(const int i) const
    {
      return law(material(i)).mean_tension(bodies.deformations[i], bodies.rotations[i]);
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
      Real        bonds = 0;
      for_each_bond(i, OneLane(), [&](const Bond &bond) {
        bonds += bond.weight * norm_square(bond.x - F * bond.X);
      });
      return law(properties).energy(F, R) +
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
    static ElasticLaw<dim, Real>
    law(const ElasticMaterial<Real> &properties)
    {
      return {properties};
    }

    /// rho c_p, the scale of damping [kg/m^2 s].
    UNDINE_HOST_DEVICE
    static Real
    sound_impedance(const ElasticMaterial<Real> &properties)
    {
      return square_root((properties.lambda + 2 * properties.mu) * properties.density);
    }

    UNDINE_HOST_DEVICE
    static void
    add(Matrix<dim, Real> &to, const Real factor, const Matrix<dim, Real> &what)
    {
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          to[a][b] += factor * what[a][b];
    }

    /// Of first Piola and Kirchhoff [Pa] (P14), with viscosity (P15), bulk viscosity and the
    /// pressure that the body carries (P10).
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
      const Real pull = law(properties).tension(F) + carried +
                        bulk_viscosity * double_contraction(C, F_rate) /
                          maximum(Real(1), double_contraction(C, C) / dim);
      auto result = law(properties).distortion_stress(F, R);
      add(result, pull, C);
      if (properties.viscosity > 0)
        add(result, properties.viscosity, law(properties).strain_rate_stress(F, F_rate));
      return result;
    }
  };
} // namespace undine::particles

#endif
