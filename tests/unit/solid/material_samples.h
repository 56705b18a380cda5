// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_unit_solid_material_samples_h
#define undine_unit_solid_material_samples_h

#include <undine/solid/material/elastic_constants.h>
#include <undine/solid/material/kinematics.h>
#include <undine/solid/material/material.h>

#include <deal.II/base/tensor.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace undine::samples
{
  /// What every registered law must be given, as "Key=value".
  inline std::vector<std::string>
  elastic_keys(const ElasticConstants &constants)
  {
    return {fmt::format("Young's modulus={}", constants.youngs_modulus),
            fmt::format("Poisson's ratio={}", constants.poissons_ratio)};
  }


  /// The same as lines of a scene.
  inline std::string
  elastic_lines(const ElasticConstants &constants)
  {
    std::string lines;
    for (const auto &key : elastic_keys(constants))
      lines += "set " + key + "\n";
    return lines;
  }


  inline Options
  elastic_options(const ElasticConstants &constants,
                  const std::string      &plane_state = "plane strain")
  {
    ParameterFile file;
    for (const auto &key : elastic_keys(constants))
      file.set(key);
    file.set("Plane state=" + plane_state);
    return Options(file);
  }


  inline std::unique_ptr<Material>
  make_material(const std::string &name, const ElasticConstants &constants)
  {
    auto material = Registry<Material>::instance().make(name);
    material->add_options(elastic_options(constants));
    return material;
  }


  /// Deformation gradients and rotations at random, the same in every run.
  class Generator
  {
  public:
    double
    between(const double lower, const double upper)
    {
      return lower + (upper - lower) * (engine() / double(std::mt19937::max()));
    }

    /// Displacement gradient with 0.5 < det(I + H) < 2.
    template <int dim>
    dealii::Tensor<2, dim>
    displacement_gradient()
    {
      while (true)
        {
          dealii::Tensor<2, dim> H;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              H[i][j] = between(-0.4, 0.4);
          const double J = determinant(dealii::unit_symmetric_tensor<dim>() + H);
          if (J > 0.5 && J < 2)
            return H;
        }
    }

    dealii::Tensor<2, 3>
    deformation_gradient()
    {
      return dealii::unit_symmetric_tensor<3>() + displacement_gradient<3>();
    }

    /// Any rotation, from a random unit quaternion.
    dealii::Tensor<2, 3>
    rotation()
    {
      dealii::Tensor<1, 4> q;
      do
        for (unsigned int i = 0; i < 4; ++i)
          q[i] = between(-1, 1);
      while (q.norm() < 0.1);
      q /= q.norm();
      dealii::Tensor<2, 3> spin; // of the vector part, w = q[3]
      spin[0][1] = -q[2];
      spin[0][2] = q[1];
      spin[1][2] = -q[0];
      spin -= transpose(spin);
      return dealii::unit_symmetric_tensor<3>() + 2 * q[3] * spin + 2 * spin * spin;
    }

  private:
    std::mt19937 engine{20240229};
  };


  /// df/dH by central differences.
  template <int dim, class Function>
  dealii::Tensor<2, dim>
  gradient_by_differences(const dealii::Tensor<2, dim> &H, const Function &f)
  {
    const double           step = 1e-5;
    dealii::Tensor<2, dim> result;
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int l = 0; l < dim; ++l)
        {
          auto above = H, below = H;
          above[k][l] += step;
          below[k][l] -= step;
          result[k][l] = (f(above) - f(below)) / (2 * step);
        }
    return result;
  }


  /// dP/dH by central differences: result[i][j][k][l] = dP_ij / dH_kl.
  template <int dim, class Function>
  dealii::Tensor<4, dim>
  tangent_by_differences(const dealii::Tensor<2, dim> &H, const Function &P)
  {
    dealii::Tensor<4, dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        result[i][j] =
          gradient_by_differences(H, [&](const dealii::Tensor<2, dim> &G) { return P(G)[i][j]; });
    return result;
  }


  /// max |A_ijkl - A_klij|
  template <int dim>
  double
  asymmetry(const dealii::Tensor<4, dim> &A)
  {
    double result = 0;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            result = std::max(result, std::abs(A[i][j][k][l] - A[k][l][i][j]));
    return result;
  }


  /// lambda delta_ij delta_kl + mu (delta_ik delta_jl + delta_il delta_jk)
  template <int dim>
  dealii::Tensor<4, dim>
  isotropic_tangent(const double lambda, const double mu)
  {
    dealii::Tensor<4, dim> A;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          A[i][i][j][j] += lambda;
          A[i][j][i][j] += mu;
          A[i][j][j][i] += mu;
        }
    return A;
  }
} // namespace undine::samples

#endif
