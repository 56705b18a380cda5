// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_scalars_scalar_bounds_h
#define undine_fluid_scalars_scalar_bounds_h

#include <undine/fluid/scalars/scalar_fluxes.h>

namespace undine
{
  /// Between which values a scalar must stay in each cell and component.
  template <int dim>
  struct ScalarBounds
  {
    Field<dim> lower, upper;
    int        reached_by_flow = 0; ///< so many cells by spread()

    /// The one value. On owned places.
    explicit ScalarBounds(const Field<dim> &value);

    /// As wide as another value asks for.
    void
    include(const PressurePlace<dim> &place, const double value);

    /// Also the values in all cells and components next to each, whose ghosts it exchanges.
    /// Collective.
    void
    include_neighbours(const ScalarFluxes<dim> &fluxes, Field<dim> &values);

    /// Bounds at the end of the stage from bounds at its begin: also those as far as the flow
    /// reaches in the stage, and what diffuses (twice the root of h k / V cells, which 84 % of it
    /// do not pass), of neighbours and what enters through sides at least. Collective.
    void
    spread(const ScalarFluxes<dim> &fluxes);
  };
} // namespace undine

#endif
