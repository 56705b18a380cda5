// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_material_positive_jacobian_h
#define undine_solid_material_positive_jacobian_h

#include <deal.II/base/tensor.h>

namespace undine
{
  /// Throws SolveError unless J = det F [1] is a positive, finite number.
  void
  assert_positive_jacobian(double J);

  /// det F [1]; throws SolveError unless it is a positive, finite number.
  double
  positive_jacobian(const dealii::Tensor<2, 3> &F);
} // namespace undine

#endif
