// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_body_forces_h
#define undine_operators_body_forces_h

#include <undine/base/core/column.h>
#include <undine/surface/surface.h>

#include <string>
#include <vector>

namespace undine
{
  /// Forces of the fluid's pressure on the nodes of a surface, [nodes] [N]; in 2D per metre of
  /// depth.
  template <int dim>
  struct PressureForces
  {
    std::vector<dealii::Tensor<1, dim>> reduced; ///< nodal_forces() of the reduced pressure
    std::vector<dealii::Tensor<1, dim>> gravity; ///< gravity_loads(); empty without gravity
  };

  /// Sums of nodal `values` over the nodes of each body, [bodies]. Every node must belong to one
  /// body only.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  sums_over_bodies(const Surface<dim> &surface, const std::vector<dealii::Tensor<1, dim>> &values);

  /// For each body, of which `values` [bodies] has one vector, and axis "NAME ball x" of a unit,
  /// for the file `statistics`.
  template <int dim>
  Columns
  body_columns(const std::string                         &name,
               const std::string                         &unit,
               const Surface<dim>                        &surface,
               const std::vector<dealii::Tensor<1, dim>> &values);

  /// For each body and axis the force of the fluid's pressure on it, "pressure force ball x" [N],
  /// and with gravity its parts: "reduced pressure force ball x" and "gravity load ball x".
  template <int dim>
  Columns
  pressure_force_columns(const Surface<dim> &surface, const PressureForces<dim> &forces);
} // namespace undine

#endif
