// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_node_masses_h
#define undine_coupled_immersed_node_masses_h

#include <undine/coupled/model/models.h>

#include <vector>

namespace undine
{
  /// A mass that no motion of a node of the bodies' surfaces, along each axis, falls short of: a
  /// third of the sum of its row of the mass matrix [kg]; infinite where the displacement is
  /// prescribed, and without inertia. Empty without bodies. Collective.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  node_masses(const Models<dim> &models);
} // namespace undine

#endif
