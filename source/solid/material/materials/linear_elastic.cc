// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/solid/material/isotropic_material.h>

#include <deal.II/physics/elasticity/standard_tensors.h>

namespace undine
{
  /// Hooke's law of small strains and small rotations, eps = sym(F) - I:
  ///
  ///     W = lambda/2 (tr eps)^2 + mu eps : eps                                            (S9)
  ///     P = lambda tr(eps) I + 2 mu eps
  ///
  /// It takes a rotation for a strain, and does not detect inversion.
  class LinearElastic : public IsotropicMaterial
  {
  public:
    double
    energy(const Gradient &F) const override
    {
      const auto   eps        = strain(F);
      const double dilatation = trace(eps);
      return 0.5 * lambda * dilatation * dilatation + mu * (eps * eps);
    }

    Gradient
    stress(const Gradient &F) const override
    {
      const auto eps = strain(F);
      return lambda * trace(eps) * Isotropic::I + 2 * mu * eps;
    }

    Tangent
    tangent(const Gradient &) const override
    {
      return lambda * Isotropic::IxI + 2 * mu * Isotropic::S;
    }

    bool
    tolerates_inversion() const override
    {
      return true;
    }

    bool
    is_objective() const override
    {
      return false;
    }

  private:
    using Isotropic = dealii::Physics::Elasticity::StandardTensors<3>;

    static dealii::SymmetricTensor<2, 3>
    strain(const Gradient &F)
    {
      return symmetrize(F) - Isotropic::I;
    }
  };


  static const Register<Material, LinearElastic>
    registered_linear_elastic("linear elastic",
                              "Hooke's law; displacements and rotations have to stay small.");
} // namespace undine
