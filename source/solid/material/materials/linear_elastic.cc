// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/solid/material/isotropic_material.h>

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
      const Gradient eps        = strain(F);
      const double   dilatation = trace(eps);
      return 0.5 * lambda * dilatation * dilatation + mu * eps.norm_square();
    }

    Gradient
    stress(const Gradient &F) const override
    {
      const Gradient eps       = strain(F);
      Gradient       result    = 2 * mu * eps;
      const double   spherical = lambda * trace(eps);
      for (unsigned int i = 0; i < 3; ++i)
        result[i][i] += spherical;
      return result;
    }

    Tangent
    tangent(const Gradient &) const override
    {
      Tangent result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            result[i][i][j][j] += lambda;
            result[i][j][i][j] += mu;
            result[i][j][j][i] += mu;
          }
      return result;
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
    static Gradient
    strain(const Gradient &F)
    {
      Gradient eps;
      for (unsigned int i = 0; i < 3; ++i)
        {
          eps[i][i] = F[i][i] - 1;
          for (unsigned int j = 0; j < i; ++j)
            eps[i][j] = eps[j][i] = 0.5 * (F[i][j] + F[j][i]);
        }
      return eps;
    }
  };


  static const Register<Material, LinearElastic>
    registered("linear elastic", "Hooke's law; displacements and rotations have to stay small.");
} // namespace undine
