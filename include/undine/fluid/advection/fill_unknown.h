// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_advection_fill_unknown_h
#define undine_fluid_advection_fill_unknown_h

#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/model/fluid_model.h>

namespace undine
{
  /// Replace values that are NaN, in freshly cleared cells and components, by the mean of the
  /// neighbours that they are joined to, the nearer ones first. Fluid that is joined to none has
  /// come in through inflows and openings of the domain, with the value there at `time` [s]; where
  /// there are none either, it takes zero. `scalar` must have a topology. Collective.
  template <int dim>
  void
  fill_unknown(Field<dim>                   &scalar,
               const FluidModel<dim>        &model,
               const BoundaryCondition<dim> &condition,
               const double                  time);
} // namespace undine

#endif
