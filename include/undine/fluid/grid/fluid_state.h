// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_fluid_state_h
#define undine_fluid_grid_fluid_state_h

#include <undine/fluid/grid/field.h>

#include <array>
#include <map>
#include <optional>
#include <string>

namespace undine
{
  /// The normal velocities on the faces [m/s]; component `axis` on the faces normal to it.
  template <int dim>
  struct Velocity
  {
    std::array<Field<dim>, dim> components;

    Field<dim> &
    operator[](const unsigned int axis)
    {
      return components[axis];
    }

    const Field<dim> &
    operator[](const unsigned int axis) const
    {
      return components[axis];
    }

    /// The topology of the fluid that all components share; nullptr: nothing is cut.
    const FluidTopology<dim> *
    topology() const
    {
      return components[0].topology().get();
    }
  };

  /// Memory of the values on this rank [bytes].
  template <int dim>
  std::size_t
  memory_consumption(const Velocity<dim> &velocity)
  {
    std::size_t sum = 0;
    for (const auto &component : velocity.components)
      sum += component.memory_consumption();
    return sum;
  }

  /// Of the halves of the dual volume of each face or piece, below [0] and above [1] it.
  template <int dim>
  using DualHalves = std::array<Velocity<dim>, 2>;

  /// At which rates the halves of dual volumes have grown as surfaces have moved.
  template <int dim>
  struct DualVolumeRates
  {
    DualHalves<dim> halves;   ///< [m^dim/s]
    double          time = 0; ///< over which they were taken [s]; 0: nothing has moved
  };

  /// Are there fields for them?
  template <int dim>
  bool
  is_in_use(const DualVolumeRates<dim> &rates)
  {
    return rates.halves[0][0].has_lattice();
  }

  /// The fluid at one time, on the staggered grid: normal velocities on cell faces, the rest in
  /// cell centres. Ghost values may be out of date; owned values count.
  template <int dim>
  struct FluidState
  {
    Velocity<dim>        velocity;     ///< [m/s]
    Velocity<dim>        acceleration; ///< Dv/Dt that the last stage has kept [m/s^2]
    Velocity<dim>        change;       ///< dv/dt of the last stage [m/s^2]
    DualVolumeRates<dim> volume_rates; ///< that the last stage has kept; empty: not in use
    Field<dim>           pressure;     ///< reduced pressure p - rho g.x [Pa]
    /// Of that pressure [s] where a stage is solved again with the one that it has led to; else it
    /// is that of the state.
    std::optional<double>             pressure_time;
    std::map<std::string, Field<dim>> scalars; ///< by name, e.g. "smoke", "temperature"
    std::map<std::string, Field<dim>>
      scalar_rates; ///< Ds/Dt that the last stage has kept [1/s], of scalars that have one
  };
} // namespace undine

#endif
