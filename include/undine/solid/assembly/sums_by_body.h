// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_sums_by_body_h
#define undine_solid_assembly_sums_by_body_h

#include <undine/solid/mesh/solid_model.h>

#include <vector>

namespace undine
{
  /// The resultant of nodal forces (a vector over the locally owned degrees of freedom) on each
  /// body, in the unit of the vector. Collective.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  sums_by_body(const SolidModel<dim> &model, const dealii::TrilinosWrappers::MPI::Vector &nodal);
} // namespace undine

#endif
