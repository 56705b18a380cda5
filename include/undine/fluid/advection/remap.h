// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_advection_remap_h
#define undine_fluid_advection_remap_h

#include <undine/fluid/advection/advection.h>

namespace undine
{
  /// The same field on the present topology of the fluid; no flow advects it. Values stay where
  /// they were. Velocities move with the volumes V_f of fluid that bodies have left: what a surface
  /// has added to that of a face in its last motion does not move like what was there, but like the
  /// fluid around,
  ///
  ///     v = [V_before v_before + (V - V_before) v_around] / V   where V > V_before. (F12)
  ///
  /// A face of next to no volume, whose velocity follows from the surfaces around it and may be any
  /// for next to no energy, would else give that velocity to all the fluid that comes to it: its
  /// energy would grow with V. Collective.
  template <int dim>
  Field<dim>
  remapped(const CharacteristicTracer<dim> &tracer,
           const Field<dim>                &field,
           const BoundaryCondition<dim>    &condition);
} // namespace undine

#endif
