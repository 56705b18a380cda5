// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_material_cofactor_h
#define undine_solid_material_cofactor_h

#include <deal.II/base/tensor.h>

namespace undine
{
  /// cof F = det F F^-T [1]: turns the rest normal times rest area into the deformed one. F has to
  /// be invertible.
  template <int dim>
  dealii::Tensor<2, dim>
  cofactor(const dealii::Tensor<2, dim> &F)
  {
    return determinant(F) * transpose(invert(F));
  }


  /// d(cof F)_ij / dF_kl = J (B_ij B_kl - B_il B_kj) [1] with J = det F, B = F^-T.
  template <int dim>
  dealii::Tensor<4, dim>
  cofactor_derivative(const dealii::Tensor<2, dim> &F)
  {
    const auto             B = transpose(invert(F));
    const double           J = determinant(F);
    dealii::Tensor<4, dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            result[i][j][k][l] = J * (B[i][j] * B[k][l] - B[i][l] * B[k][j]);
    return result;
  }
} // namespace undine

#endif
