// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_fluid_state_h
#define undine_fluid_fluid_state_h

#include <undine/fluid/field.h>

#include <array>
#include <map>
#include <string>

namespace undine
{
  /// The fluid at one time, on the staggered grid: normal velocities on cell faces, the rest in
  /// cell centres. Fields carry ghost layers; owned values are the truth.
  template <int dim>
  struct FluidState
  {
    std::array<Field<dim>, dim>       velocity; ///< component `axis` on faces normal to it [m/s]
    Field<dim>                        pressure; ///< reduced pressure p - rho g.x [Pa]
    std::map<std::string, Field<dim>> scalars;  ///< by name, e.g. "smoke", "temperature"
  };
} // namespace undine

#endif
