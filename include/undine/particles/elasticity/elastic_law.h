// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_elastic_law_h
#define undine_particles_elasticity_elastic_law_h

#include <undine/particles/elasticity/volume_law.h>
#include <undine/particles/math/rotation.h>
#include <undine/particles/model/elastic_material.h>

namespace undine::particles
{
  /// The energy W(F) of a material (P14) and what follows from it. Its stress of first Piola and
  /// Kirchhoff is
  ///     P = dW/dF = D(F) + t(F) cof F,
  /// t being all that acts as a pressure does. In the plane F_33 = 1 (plane strain).
  template <int dim, class Real>
  struct ElasticLaw
  {
    using Gradient = Matrix<dim, Real>;

    const ElasticMaterial<Real> &properties;

    /// R of F; the linear law knows no rotations.
    UNDINE_HOST_DEVICE
    Gradient
    rotation(const Gradient &F, const Gradient &last) const
    {
      return properties.law == Law::linear_elastic ? Gradient::diagonal(1) : rotation_of(F, last);
    }

    /// W [Pa]
    UNDINE_HOST_DEVICE
    Real
    energy(const Gradient &F, const Gradient &R) const
    {
      const Real lambda = properties.lambda, mu = properties.mu;
      if (properties.law == Law::corotated)
        {
          Real square = 0;
          for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b)
              square += (F[a][b] - R[a][b]) * (F[a][b] - R[a][b]);
          return mu * square + volume().energy(determinant(F));
        }
      // What is small of second order is the difference of what is not: beyond single precision.
      const ElasticMaterial<double> exact = {lambda,
                                             mu,
                                             properties.density,
                                             properties.hourglass,
                                             properties.damping,
                                             properties.bulk_damping,
                                             properties.contact,
                                             properties.viscosity,
                                             properties.drag,
                                             properties.law};
      Matrix<dim, double>           gradient;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          gradient[a][b] = F[a][b];
      return static_cast<Real>(ElasticLaw<dim, double>{exact}.energy(gradient));
    }

    /// The same of all laws but the corotated one.
    UNDINE_HOST_DEVICE
    Real
    energy(const Gradient &F) const
    {
      const Real lambda = properties.lambda, mu = properties.mu;
      const Real J = determinant(F), first = double_contraction(F, F) + (3 - dim);
      if (properties.law == Law::neo_hookean)
        return mu / 2 * (first - 3) + neo_hookean_energy(J) + volume().energy(J);
      if (properties.law == Law::nearly_incompressible_rubber)
        return mu / 2 * (distortion(J).value * first - 3) + volume().energy(J);
      const auto E = strain(F);
      return lambda / 2 * trace(E) * trace(E) + mu * double_contraction(E, E) + volume().energy(J);
    }

    /// D [Pa]
    UNDINE_HOST_DEVICE
    Gradient
    distortion_stress(const Gradient &F, const Gradient &R) const
    {
      const Real mu = properties.mu;
      Gradient   result;
      if (properties.law == Law::corotated)
        {
          for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b)
              result[a][b] = 2 * mu * (F[a][b] - R[a][b]);
          return result;
        }
      if (properties.law == Law::linear_elastic)
        return hooke(strain(F));
      if (properties.law == Law::saint_venant_kirchhoff)
        return F * hooke(strain(F));
      const Real factor =
        properties.law == Law::neo_hookean ? mu : mu * distortion(determinant(F)).value;
      const auto C = cofactors(F);
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          result[a][b] = factor * (F[a][b] - C[a][b]); // small, as is t, for the rounding
      return result;
    }

    /// t [Pa]
    UNDINE_HOST_DEVICE
    Real
    tension(const Gradient &F) const
    {
      const Real J      = determinant(F);
      Real       result = volume().tension(J);
      if (properties.law == Law::neo_hookean)
        result += neo_hookean_tension(J) + properties.mu;
      if (properties.law == Law::nearly_incompressible_rubber)
        {
          const auto s = distortion(J);
          result +=
            properties.mu * (s.value + s.slope / 2 * (double_contraction(F, F) + (3 - dim)));
        }
      return result;
    }

    /// The mean stress that bears a pressure around a particle [Pa].
    UNDINE_HOST_DEVICE
    Real
    mean_tension(const Gradient &F, const Gradient &R) const
    {
      if (properties.law == Law::corotated)
        return tension(F);
      const Real J = maximum(determinant(F), VolumeLaw<Real>::flat);
      return double_contraction(distortion_stress(F, R), F) / (dim * J) + tension(F);
    }

    /// Change of P with F; rigid motions change no stress, and it is symmetric and not negative:
    /// what is left out of the derivative is P times the change of the rotation, and of the last
    /// two laws all that is not of first order in strains but for the volume's part.
    UNDINE_HOST_DEVICE
    Gradient
    stress_change(const Gradient &F, const Gradient &R, const Gradient &change) const
    {
      if (properties.law == Law::linear_elastic)
        return hooke(symmetric(change));
      const auto C           = cofactors(F);
      const Real J           = determinant(F);
      const Real pull        = pull_stiffness(J) * double_contraction(C, change);
      const bool is_of_green = properties.law == Law::saint_venant_kirchhoff;
      Gradient   result = is_of_green ? strain_rate_stress(F, change) : without_turn(R, change);
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          result[a][b] =
            (is_of_green ? Real(1) : 2 * properties.mu) * result[a][b] + pull * C[a][b];
      return result;
    }

    /// Of a rate of F, F (lambda tr(e) I + 2 mu e), e = sym(F^T rate): what of P belongs to the
    /// rate of Green and Lagrange's strain. Its power is never negative, and none of a rotation.
    UNDINE_HOST_DEVICE
    Gradient
    strain_rate_stress(const Gradient &F, const Gradient &rate) const
    {
      return F * hooke(symmetric(transposed(F) * rate));
    }

    /// The square of the speed of pressure waves where they are fastest [m^2/s^2].
    UNDINE_HOST_DEVICE
    Real
    sound_square(const Gradient &F) const
    {
      const Real lambda = properties.lambda, mu = properties.mu;
      if (properties.law == Law::linear_elastic)
        return (lambda + 2 * mu) / properties.density;
      const Real J = determinant(F), faces = 1 + excess(cofactors(F));
      if (properties.law == Law::corotated)
        return (2 * mu + volume().stiffness(J) * faces) / properties.density;
      Real modulus = 0;
      if (properties.law == Law::neo_hookean)
        modulus = mu + (neo_hookean_stiffness(J) + volume().stiffness(J)) * faces;
      else if (properties.law == Law::nearly_incompressible_rubber)
        {
          const Real j = maximum(J, VolumeLaw<Real>::flat);
          modulus      = volume().stiffness(J) * faces +
                    mu * distortion(j).value *
                      (Real(5) / 9 * (double_contraction(F, F) + (3 - dim)) * faces / (j * j) -
                       Real(1) / 3);
        }
      else
        modulus = (lambda + 2 * mu) * (1 + excess(F)) + volume().stiffness(J) * faces +
                  maximum(Real(0), lambda * trace(strain(F))) + mu * excess(F);
      return modulus / properties.density;
    }

    /// The same of strain_rate_stress().
    UNDINE_HOST_DEVICE
    Real
    strain_rate_square(const Gradient &F) const
    {
      return (properties.lambda + 2 * properties.mu) * (1 + excess(F)) / properties.density;
    }

  private:
    /// What W depends on the volume, with the barrier of laws that would collapse without.
    UNDINE_HOST_DEVICE
    VolumeLaw<Real>
    volume() const
    {
      const Real lambda = properties.lambda, mu = properties.mu;
      switch (properties.law)
        {
          case Law::corotated:
            return {lambda, lambda + 2 * mu};
          case Law::nearly_incompressible_rubber:
            return {lambda + Real(2) / 3 * mu, lambda + 2 * mu};
          case Law::linear_elastic:
            return {Real(0), Real(0)};
          default:
            return {Real(0), lambda + 2 * mu};
        }
    }

    /// d2W/dJ2 with the rest of F held, not negative [Pa].
    UNDINE_HOST_DEVICE
    Real
    pull_stiffness(const Real J) const
    {
      switch (properties.law)
        {
          case Law::neo_hookean:
            return maximum(Real(0),
                           neo_hookean_stiffness(J) + volume().stiffness(J) - properties.mu);
          case Law::nearly_incompressible_rubber:
            return volume().stiffness(J) - Real(2) / 3 * properties.mu;
          default:
            return volume().stiffness(J);
        }
    }

    /// What neo-Hookean energy depends on J alone, of second order below `flat`. @{
    UNDINE_HOST_DEVICE
    Real
    neo_hookean_energy(const Real J) const
    {
      const Real j = maximum(J, VolumeLaw<Real>::flat), below = J - j;
      return properties.lambda / 4 * (j * j - 1) -
             (properties.mu + properties.lambda / 2) * std::log(j) +
             below * (neo_hookean_tension(j) + neo_hookean_stiffness(j) * below / 2);
    }

    UNDINE_HOST_DEVICE
    Real
    neo_hookean_tension(const Real J) const
    {
      const Real j = maximum(J, VolumeLaw<Real>::flat);
      return properties.lambda / 2 * (j - 1 / j) - properties.mu / j +
             neo_hookean_stiffness(j) * (J - j);
    }

    UNDINE_HOST_DEVICE
    Real
    neo_hookean_stiffness(const Real J) const
    {
      const Real j = maximum(J, VolumeLaw<Real>::flat);
      return properties.lambda / 2 * (1 + 1 / (j * j)) + properties.mu / (j * j);
    }
    /// @}

    /// J^(-2/3) and its derivative, linear below `flat`.
    struct Distortion
    {
      Real value, slope;
    };

    UNDINE_HOST_DEVICE
    static Distortion
    distortion(const Real J)
    {
      const Real j = maximum(J, VolumeLaw<Real>::flat), root = std::cbrt(j);
      const Real value = 1 / (root * root), slope = -Real(2) / 3 * value / j;
      return {value + slope * (J - j), slope};
    }

    /// Of Green and Lagrange, in the linear law of small displacements.
    UNDINE_HOST_DEVICE
    Gradient
    strain(const Gradient &F) const
    {
      auto E = properties.law == Law::linear_elastic ? symmetric(F) : transposed(F) * F;
      for (int a = 0; a < dim; ++a)
        E[a][a] -= 1;
      if (properties.law != Law::linear_elastic)
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            E[a][b] /= 2;
      return E;
    }

    /// lambda tr(e) I + 2 mu e
    UNDINE_HOST_DEVICE
    Gradient
    hooke(const Gradient &e) const
    {
      auto result = Gradient::diagonal(properties.lambda * trace(e));
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          result[a][b] += 2 * properties.mu * e[a][b];
      return result;
    }

    /// Of |A A^T - 1|, which bounds the change of the largest stretch's square.
    UNDINE_HOST_DEVICE
    static Real
    excess(const Gradient &A)
    {
      Real square = 0;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          {
            Real entry = a == b ? Real(-1) : Real(0);
            for (int c = 0; c < dim; ++c)
              entry += A[a][c] * A[b][c];
            square += entry * entry;
          }
      return square_root(square);
    }

    UNDINE_HOST_DEVICE
    static Gradient
    symmetric(const Gradient &A)
    {
      Gradient result;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          result[a][b] = (A[a][b] + A[b][a]) / 2;
      return result;
    }

    /// The part of a change of F that is no rotation, R sym(R^T dF).
    UNDINE_HOST_DEVICE
    static Gradient
    without_turn(const Gradient &R, const Gradient &change)
    {
      auto in_body = Gradient::diagonal(0);
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
  };
} // namespace undine::particles

#endif
