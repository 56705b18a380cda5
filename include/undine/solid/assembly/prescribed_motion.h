// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_prescribed_motion_h
#define undine_solid_assembly_prescribed_motion_h

#include <undine/solid/mesh/solid_model.h>

namespace undine
{
  /// The fixed degrees of freedom of a vector over the locally owned ones become what their
  /// boundaries prescribe, g(t) [m], dg/dt [m/s] or d^2g/dt^2 [m/s^2]; derivatives are differences
  /// over times within `dt` [s], central ones except at t < dt: expressions need no meaning for t <
  /// 0. Collective. The first throws InputError, naming the boundary, if g(t) is not finite.
  /// @{
  template <int dim>
  void
  prescribe_displacement(dealii::TrilinosWrappers::MPI::Vector &displacement,
                         const SolidModel<dim>                 &model,
                         double                                 time);
  template <int dim>
  void
  prescribe_velocity(dealii::TrilinosWrappers::MPI::Vector &velocity,
                     const SolidModel<dim>                 &model,
                     double                                 time,
                     double                                 dt);
  template <int dim>
  void
  prescribe_acceleration(dealii::TrilinosWrappers::MPI::Vector &acceleration,
                         const SolidModel<dim>                 &model,
                         double                                 time,
                         double                                 dt);
  /// @}

  /// The fixed degrees of freedom become zero.
  template <int dim>
  void
  clear_fixed(dealii::TrilinosWrappers::MPI::Vector &vector, const SolidModel<dim> &model);
} // namespace undine

#endif
