// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_budget_inertia_h
#define undine_coupled_budget_inertia_h

#include <undine/coupled/model/models.h>

namespace undine
{
  /// Of fluid and bodies on grids and elements, the sum of mass and the square of its extent
  /// [kg m^2]. With the square of a rate [1/s] it is an energy. Collective.
  template <int dim>
  double
  inertia(const Models<dim> &models);
} // namespace undine

#endif
