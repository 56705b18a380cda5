// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_body_forces_h
#define undine_operators_body_forces_h

#include <undine/base/core/column.h>
#include <undine/surface/surface.h>

#include <string>
#include <vector>

namespace undine
{
  /// What the fluid's pressure does to the nodes of a surface [N]; in 2D per metre of depth.
  template <int dim>
  struct PressureForces
  {
    std::vector<dealii::Tensor<1, dim>> reduced; ///< nodal_forces() of the reduced pressure
    std::vector<dealii::Tensor<1, dim>> gravity; ///< gravity_loads(); empty without gravity
  };

  /// Sums over the nodes of each body. Every node must belong to one body only.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  sums_over_bodies(const Surface<dim> &surface, const std::vector<dealii::Tensor<1, dim>> &values);

  /// For each body and axis the sum of forces in the nodes, "NAME ball x" [N].
  template <int dim>
  Columns
  body_force_columns(const std::string                         &name,
                     const Surface<dim>                        &surface,
                     const std::vector<dealii::Tensor<1, dim>> &forces);

  /// For each body and axis the force of the fluid's pressure on it, "pressure force ball x" [N],
  /// and with gravity its parts: "reduced pressure force ball x" and "gravity load ball x".
  template <int dim>
  Columns
  pressure_force_columns(const Surface<dim> &surface, const PressureForces<dim> &forces);
} // namespace undine

#endif
