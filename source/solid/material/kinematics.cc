// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/core/registry.h>
#include <undine/solid/material/cofactor_derivative.h>
#include <undine/solid/material/kinematics.h>
#include <undine/solid/material/positive_jacobian.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  using dealii::Tensor;

  namespace
  {
    /// I + H, where the directions that H does not know have F_33 = `thickness_stretch`.
    template <int dim>
    Tensor<2, 3>
    embed(const Tensor<2, dim> &H, const double thickness_stretch)
    {
      Tensor<2, 3> F;
      F[2][2] = thickness_stretch;
      for (unsigned int i = 0; i < dim; ++i)
        {
          for (unsigned int j = 0; j < dim; ++j)
            F[i][j] = H[i][j];
          F[i][i] = 1 + H[i][i];
        }
      return F;
    }


    template <int dim>
    Tensor<2, dim>
    restrict_to_space(const Tensor<2, 3> &P)
    {
      Tensor<2, dim> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result[i][j] = P[i][j];
      return result;
    }


    template <int dim>
    Tensor<4, dim>
    restrict_to_space(const Tensor<4, 3> &A)
    {
      Tensor<4, dim> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result[i][j] = restrict_to_space<dim>(A[i][j]);
      return result;
    }


    /// det F, positive if the law needs that.
    double
    valid_jacobian(const Material &material, const Tensor<2, 3> &F)
    {
      const double J = determinant(F);
      if (!material.tolerates_inversion())
        assert_positive_jacobian(J);
      return J;
    }


    /// W with the law's U(det F).
    double
    whole_energy(const Material &material, const Tensor<2, 3> &F)
    {
      const double W = material.energy(F);
      return material.has_separate_volumetric_part()
               ? W + material.volumetric_energy(determinant(F))
               : W;
    }


    /// P with U'(J) cof F.
    Tensor<2, 3>
    whole_stress(const Material &material, const Tensor<2, 3> &F)
    {
      const auto P = material.stress(F);
      if (!material.has_separate_volumetric_part())
        return P;
      return P + material.volumetric_stress(determinant(F)) * cofactor(F);
    }


    /// A with U'' (cof F)_ij (cof F)_kl + U' d(cof F)_ij / dF_kl.
    Tensor<4, 3>
    whole_tangent(const Material &material, const Tensor<2, 3> &F)
    {
      const auto A = material.tangent(F);
      if (!material.has_separate_volumetric_part())
        return A;
      const double J        = determinant(F);
      const auto   gradient = cofactor(F); // of J
      return A + material.volumetric_tangent(J) * outer_product(gradient, gradient) +
             material.volumetric_stress(J) * cofactor_derivative(F);
    }


    /// One Newton step for P_33 = 0, which is a minimum of W over F_33. Laws that need det F > 0
    /// move by a factor between 1/2 and 2, downhill where W is not convex.
    double
    next_stretch(const Material &material, const Tensor<2, 3> &F)
    {
      const double stretch = F[2][2];
      const double P33     = whole_stress(material, F)[2][2];
      const double A3333   = whole_tangent(material, F)[2][2][2][2];
      const double newton  = stretch - P33 / A3333;
      if (material.tolerates_inversion())
        return newton;
      if (A3333 <= 0)
        return P33 > 0 ? stretch / 2 : stretch * 2;
      return std::clamp(newton, stretch / 2, stretch * 2);
    }


    /// F with the F_33 at which P_33 = 0.
    Tensor<2, 3>
    free_thickness(const Material &material, const Tensor<2, 2> &H)
    {
      const unsigned int max_steps = 60;
      const double       tolerance = 1e-10; // of a quadratic method: the next step is rounding

      auto F = embed<2>(H, 1);
      valid_jacobian(material, F);
      for (unsigned int step = 0; step < max_steps; ++step)
        {
          const double stretch = F[2][2];
          F[2][2]              = next_stretch(material, F);
          if (std::abs(F[2][2] - stretch) <= tolerance * std::abs(stretch))
            return F;
        }
      throw SolveError(fmt::format("plane stress: no thickness makes the stress across the sheet "
                                   "vanish (last F_33 = {:g}), the sheet is stretched beyond what "
                                   "its material law allows. Try smaller steps or loads, or the "
                                   "neo-Hookean law.",
                                   F[2][2]));
    }
  } // namespace


  template <int dim>
  void
  Kinematics<dim>::add_options(const Options &)
  {
  }


  /// F has fixed entries in the directions that H does not know: 3D and plane strain.
  template <int dim>
  class FixedThickness : public Kinematics<dim>
  {
  public:
    bool
    separates_volumetric_part(const Material &material) const override
    {
      return material.has_separate_volumetric_part();
    }

    PointResponse<dim>
    respond(const Material &material, const Tensor<2, dim> &H) const override
    {
      const auto         F = embed<dim>(H, 1);
      PointResponse<dim> point;
      point.jacobian          = valid_jacobian(material, F);
      point.thickness_stretch = 1;
      point.stress            = restrict_to_space<dim>(material.stress(F));
      point.tangent           = restrict_to_space<dim>(material.tangent(F));
      return point;
    }

    PointStress<dim>
    stress(const Material &material, const Tensor<2, dim> &H) const override
    {
      const auto   F = embed<dim>(H, 1);
      const double J = valid_jacobian(material, F);
      return {restrict_to_space<dim>(material.stress(F)), J, 1.};
    }

    Thickness<dim>
    thickness(const Material &, const Tensor<2, dim> &) const override
    {
      return {1., Tensor<2, dim>()};
    }

    double
    energy(const Material &material, const Tensor<2, dim> &H) const override
    {
      const auto F = embed<dim>(H, 1);
      valid_jacobian(material, F);
      return material.energy(F);
    }
  };


  /// F_33 lets P_33 vanish.
  class PlaneStress : public Kinematics<2>
  {
  public:
    bool
    separates_volumetric_part(const Material &) const override
    {
      return false;
    }

    PointResponse<2>
    respond(const Material &material, const Gradient &H) const override;

    PointStress<2>
    stress(const Material &material, const Gradient &H) const override;

    Thickness<2>
    thickness(const Material &material, const Gradient &H) const override;

    double
    energy(const Material &material, const Gradient &H) const override;
  };


  PointResponse<2>
  PlaneStress::respond(const Material &material, const Gradient &H) const
  {
    const auto       F = free_thickness(material, H);
    const auto       A = whole_tangent(material, F);
    PointResponse<2> point;
    point.jacobian          = determinant(F);
    point.thickness_stretch = F[2][2];
    point.stress            = restrict_to_space<2>(whole_stress(material, F));
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        for (unsigned int k = 0; k < 2; ++k)
          for (unsigned int l = 0; l < 2; ++l)
            point.tangent[i][j][k][l] =
              A[i][j][k][l] - A[i][j][2][2] * A[2][2][k][l] / A[2][2][2][2];
    return point;
  }


  PointStress<2>
  PlaneStress::stress(const Material &material, const Gradient &H) const
  {
    const auto F = free_thickness(material, H);
    return {restrict_to_space<2>(whole_stress(material, F)), determinant(F), F[2][2]};
  }


  Thickness<2>
  PlaneStress::thickness(const Material &material, const Gradient &H) const
  {
    const auto F = free_thickness(material, H);
    const auto A = whole_tangent(material, F);
    return {F[2][2], restrict_to_space<2>(A[2][2]) / -A[2][2][2][2]};
  }


  double
  PlaneStress::energy(const Material &material, const Gradient &H) const
  {
    return whole_energy(material, free_thickness(material, H));
  }


  static const Register<Kinematics<2>, FixedThickness<2>>
    plane_strain("plane strain", "A slice of a long body: no strain across the plane.");
  static const Register<Kinematics<2>, PlaneStress>
    plane_stress("plane stress", "A thin sheet: no stress across the plane.");


  template <>
  std::unique_ptr<Kinematics<2>>
  choose_kinematics<2>(const Options &options)
  {
    return options.choose<Kinematics<2>>(
      "Plane state", "plane strain", "What is zero across the plane: strain or stress.");
  }


  template <>
  std::unique_ptr<Kinematics<3>>
  choose_kinematics<3>(const Options &)
  {
    return std::make_unique<FixedThickness<3>>();
  }


  template class Kinematics<2>;
  template class Kinematics<3>;
} // namespace undine
