// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/solid/material/isotropic_material.h>

#include <deal.II/physics/elasticity/kinematics.h>

namespace undine
{
  namespace deformation = dealii::Physics::Elasticity::Kinematics;


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
      const auto   E          = strain(F);
      const double dilatation = trace(E);
      return 0.5 * lambda * dilatation * dilatation + mu * (E * E);
    }

    Gradient
    stress(const Gradient &F) const override
    {
      return F * second_stress(F);
    }

    Tangent
    tangent(const Gradient &F) const override
    {
      const auto S      = second_stress(F);
      const auto b      = deformation::b(F); // F F^T
      Tangent    result = lambda * outer_product(F, F);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int k = 0; k < 3; ++k)
            {
              result[i][j][k] += mu * F[k][j] * F[i];
              result[i][j][k][j] += mu * b[i][k];
              result[i][j][i][k] += S[j][k];
            }
      return result;
    }

  private:
    /// E = sym H + H^T H / 2 with H = F - I: what rounding leaves of F^T F - I is too little of
    /// small strains.
    static dealii::SymmetricTensor<2, 3>
    strain(const Gradient &F)
    {
      const Gradient H = F - dealii::unit_symmetric_tensor<3>();
      return symmetrize(H + 0.5 * transpose(H) * H);
    }

    dealii::SymmetricTensor<2, 3>
    second_stress(const Gradient &F) const
    {
      const auto E = strain(F);
      return lambda * trace(E) * dealii::unit_symmetric_tensor<3>() + 2 * mu * E;
    }
  };


  static const Register<Material, SaintVenantKirchhoff> registered_saint_venant_kirchhoff(
    "Saint Venant-Kirchhoff",
    "Hooke's law in Green-Lagrange strain: large rotations, moderate strains.");
} // namespace undine
