// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_material_cofactor_derivative_h
#define undine_solid_material_cofactor_derivative_h

#include <deal.II/base/tensor.h>

namespace undine
{
  /// d(cof F)_ij / dF_kl = J (B_ij B_kl - B_il B_kj) [1] with J = det F, B = F^-T. F has to be
  /// invertible, as it has to be for dealii::cofactor().
  template <int dim>
  dealii::Tensor<4, dim>
  cofactor_derivative(const dealii::Tensor<2, dim> &F)
  {
    const auto B      = transpose(invert(F));
    auto       result = outer_product(B, B);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          result[i][j][k] -= B[k][j] * B[i];
    return determinant(F) * result;
  }
} // namespace undine

#endif
