// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/solid/material/isotropic_material.h>

namespace undine
{
  /// Hooke's law between the Green-Lagrange strain E = (F^T F - I) / 2 and the second
  /// Piola-Kirchhoff stress S [Holzapfel, Nonlinear Solid Mechanics, section 6.5]:
  ///
  ///     W = lambda/2 (tr E)^2 + mu E : E                                                  (S10)
  ///     P = F S,  S = lambda tr(E) I + 2 mu E
  ///     A_ijkl = delta_ik S_jl + lambda F_ij F_kl + mu (F_il F_kj + (F F^T)_ik delta_jl)
  ///
  /// Large rotations, small strains: in strong compression it gets softer, not stiffer.
  class SaintVenantKirchhoff : public IsotropicMaterial
  {
  public:
    double
    energy(const Gradient &F) const override
    {
      const Gradient E          = strain(F);
      const double   dilatation = trace(E);
      return 0.5 * lambda * dilatation * dilatation + mu * E.norm_square();
    }

    Gradient
    stress(const Gradient &F) const override
    {
      return F * second_stress(F);
    }

    Tangent
    tangent(const Gradient &F) const override
    {
      const Gradient S = second_stress(F);
      Gradient       left; // F F^T
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int k = 0; k < 3; ++k)
          left[i][k] = F[i] * F[k];

      Tangent result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int k = 0; k < 3; ++k)
            {
              for (unsigned int l = 0; l < 3; ++l)
                result[i][j][k][l] += lambda * F[i][j] * F[k][l] + mu * F[i][l] * F[k][j];
              result[i][j][k][j] += mu * left[i][k];
              result[i][j][i][k] += S[j][k];
            }
      return result;
    }

  private:
    static Gradient
    strain(const Gradient &F)
    {
      Gradient E = 0.5 * (transpose(F) * F);
      for (unsigned int i = 0; i < 3; ++i)
        E[i][i] -= 0.5;
      return E;
    }

    Gradient
    second_stress(const Gradient &F) const
    {
      const Gradient E = strain(F);
      Gradient       S = 2 * mu * E;
      for (unsigned int i = 0; i < 3; ++i)
        S[i][i] += lambda * trace(E);
      return S;
    }
  };


  static const Register<Material, SaintVenantKirchhoff>
    registered("Saint Venant-Kirchhoff",
               "Hooke's law in Green-Lagrange strain: large rotations, moderate strains.");
} // namespace undine
