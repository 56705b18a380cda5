// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_material_strain_invariants_h
#define undine_solid_material_strain_invariants_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <cmath>

namespace undine
{
  /// Invariants of a deformation gradient F [1] as differences from those of rest, by H = F - I:
  /// energies are of the order of H^2, of which rounding would leave little in differences of
  /// numbers of order 1. @{

  /// I_1 - 3 = F : F - 3 = 2 tr H + H : H.
  inline double
  squared_stretches(const dealii::Tensor<2, 3> &F)
  {
    const auto H = F - dealii::unit_symmetric_tensor<3>();
    return 2 * trace(H) + H.norm_square();
  }

  /// J - 1 = tr H + II_H + III_H.
  inline double
  dilatation(const dealii::Tensor<2, 3> &F)
  {
    const dealii::Tensor<2, 3> H      = F - dealii::unit_symmetric_tensor<3>();
    const double               trace  = dealii::trace(H);
    const double               second = (trace * trace - dealii::trace(H * H)) / 2;
    return trace + second + determinant(H);
  }

  /// ln J, where J = det F > 0.
  inline double
  logarithmic_dilatation(const dealii::Tensor<2, 3> &F, const double J)
  {
    const double difference = dilatation(F);
    return std::abs(difference) < 0.1 ? std::log1p(difference) : std::log(J);
  }
  /// @}
} // namespace undine

#endif
