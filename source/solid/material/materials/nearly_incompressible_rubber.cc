// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/solid/material/isotropic_material.h>
#include <undine/solid/material/positive_jacobian.h>
#include <undine/solid/material/strain_invariants.h>

#include <cmath>

namespace undine
{
  /// Neo-Hookean law split into distortion and dilatation, with J = det F, I_1 = F : F, B = F^-T,
  /// G = mu and K the bulk modulus:
  ///
  ///     W = G/2 (J^(-2/3) I_1 - 3) + U(J),  U = K/2 (J - 1)^2                             (S12)
  ///     P = g (F - I_1/3 B) + U'(J) J B,  g = mu J^(-2/3)
  ///     A_ijkl = g (delta_ik delta_jl - 2/3 (F_ij B_kl + B_ij F_kl)
  ///                 + 2/9 I_1 B_ij B_kl + I_1/3 B_il B_kj) + the part of U
  ///
  /// [Holzapfel, Nonlinear Solid Mechanics, sections 6.4 and 6.5; Simo, Taylor, Pister,
  /// Comput. Meth. Appl. Mech. Eng. 51 (1985) 177-208, for the element that takes U at a mean J].
  class NearlyIncompressibleRubber : public IsotropicMaterial
  {
  public:
    double
    energy(const Gradient &F) const override
    {
      const double ln_J   = logarithmic_dilatation(F, positive_jacobian(F));
      const double factor = std::expm1(-2. / 3. * ln_J); // J^(-2/3) - 1
      return 0.5 * mu * (3 * factor + (1 + factor) * squared_stretches(F));
    }

    Gradient
    stress(const Gradient &F) const override
    {
      const double g = mu * distortion_factor(positive_jacobian(F));
      return g * (F - F.norm_square() / 3 * transpose(invert(F)));
    }

    Tangent
    tangent(const Gradient &F) const override
    {
      const double   g  = mu * distortion_factor(positive_jacobian(F));
      const Gradient B  = transpose(invert(F));
      const double   I1 = F.norm_square();

      Tangent result = outer_product((2. / 9.) * g * I1 * B - (2. / 3.) * g * F, B) -
                       (2. / 3.) * g * outer_product(B, F);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            for (unsigned int k = 0; k < 3; ++k)
              result[i][j][k] += (g * I1 / 3) * B[k][j] * B[i];
            result[i][j][i][j] += g;
          }
      return result;
    }

    bool
    has_separate_volumetric_part() const override
    {
      return true;
    }

    double
    volumetric_energy(const double J) const override
    {
      return 0.5 * bulk * (J - 1) * (J - 1);
    }

    double
    volumetric_stress(const double J) const override
    {
      return bulk * (J - 1);
    }

    double
    volumetric_tangent(const double) const override
    {
      return bulk;
    }

  private:
    /// J^(-2/3)
    static double
    distortion_factor(const double J)
    {
      const double root = std::cbrt(J);
      return 1 / (root * root);
    }
  };


  static const Register<Material, NearlyIncompressibleRubber>
    registered_nearly_incompressible_rubber(
      "nearly incompressible rubber",
      "Large strains at nearly constant volume: Poisson's ratio up to 0.4999 and beyond "
      "without locking, by a dilatation averaged over each cell.");
} // namespace undine
