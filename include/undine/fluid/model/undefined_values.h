// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_model_undefined_values_h
#define undine_fluid_model_undefined_values_h

#include <undine/fluid/model/fluid_model.h>

#include <memory>
#include <string>

namespace undine
{
  /// Where one of the scene's expressions gives the fluid no finite number, as a complaint that
  /// names section, key, place and time; empty if they all do: of the initial velocity, and of the
  /// velocity of inflows and the pressure of openings at `time` [s]. `topology`: of the fluid;
  /// nullptr: nothing is cut. For steps that have failed. Collective. @{
  template <int dim>
  std::string
  undefined_initial_velocity(const FluidModel<dim>                           &model,
                             const std::shared_ptr<const FluidTopology<dim>> &topology);

  template <int dim>
  std::string
  undefined_boundary_value(const FluidModel<dim>                           &model,
                           const std::shared_ptr<const FluidTopology<dim>> &topology,
                           const double                                     time);
  /// @}
} // namespace undine

#endif
