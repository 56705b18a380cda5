// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/solid/material/isotropic_material.h>
#include <undine/solid/material/positive_jacobian.h>
#include <undine/solid/material/strain_invariants.h>

namespace undine
{
  /// Compressible neo-Hookean law, with J = det F, I_1 = F : F and B = F^-T:
  ///
  ///     W = mu/2 (I_1 - 3 - 2 ln J) + lambda/4 (J^2 - 1 - 2 ln J)                         (S11)
  ///     P = mu F + q B,  q = lambda/2 (J^2 - 1) - mu
  ///     A_ijkl = mu delta_ik delta_jl + lambda J^2 B_ij B_kl - q B_il B_kj
  ///
  /// [Ciarlet, Mathematical Elasticity I, section 4.10; Wriggers, Nonlinear Finite Element Methods,
  /// section 3.3]. The frequent alternative lambda/2 (ln J)^2 agrees to second order in J - 1, but
  /// is not convex in J beyond J = e, so the solid gets softer when blown up; this law is
  /// polyconvex for lambda >= 0, and its stress needs no logarithm.
  class NeoHookean : public IsotropicMaterial
  {
  public:
    double
    energy(const Gradient &F) const override
    {
      const double ln_J   = logarithmic_dilatation(F, positive_jacobian(F));
      const double change = dilatation(F);
      return 0.5 * mu * (squared_stretches(F) - 2 * ln_J) +
             0.25 * lambda * (change * (2 + change) - 2 * ln_J);
    }

    Gradient
    stress(const Gradient &F) const override
    {
      const double J = positive_jacobian(F);
      return mu * F + pressure_factor(J) * transpose(invert(F));
    }

    Tangent
    tangent(const Gradient &F) const override
    {
      const double   J         = positive_jacobian(F);
      const Gradient B         = transpose(invert(F));
      const double   stiffness = lambda * J * J;
      const double   q         = pressure_factor(J);

      Tangent result = stiffness * outer_product(B, B);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            for (unsigned int k = 0; k < 3; ++k)
              result[i][j][k] -= q * B[k][j] * B[i];
            result[i][j][i][j] += mu;
          }
      return result;
    }

  private:
    /// q of the equations above [Pa].
    double
    pressure_factor(const double J) const
    {
      return 0.5 * lambda * (J * J - 1) - mu;
    }
  };


  static const Register<Material, NeoHookean>
    registered_neo_hookean("neo-Hookean",
                           "Compressible rubber or tissue: large rotations and large strains.");
} // namespace undine
