// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_place_in_domain_h
#define undine_fluid_grid_place_in_domain_h

#include <undine/base/options/options.h>
#include <undine/fluid/grid/mac_grid.h>

#include <string>

namespace undine
{
  /// Throws InputError unless `place` [m], the value of `key`, lies in the domain or on its sides.
  template <int dim>
  void
  check_in_domain(const Options            &options,
                  const std::string        &key,
                  const dealii::Point<dim> &place,
                  const MacGrid<dim>       &grid);
} // namespace undine

#endif
