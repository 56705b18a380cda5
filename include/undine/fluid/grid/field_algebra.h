// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_field_algebra_h
#define undine_fluid_grid_field_algebra_h

#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/grid/mac_grid.h>

namespace undine
{
  /// Give owned divided points the mean of their sub-cells or sub-faces, see SubLattice; closed
  /// ones get zero. Not collective. @{
  template <int dim>
  void
  set_means(Field<dim> &field, const MacGrid<dim> &grid);

  template <int dim>
  void
  set_means(Velocity<dim> &velocity, const MacGrid<dim> &grid);
  /// @}

  /// Volume of the fluid in every owned cell and component [m^dim].
  template <int dim>
  void
  set_volumes(Field<dim> &volumes, const MacGrid<dim> &grid);

  /// field += factor * change on owned points and all sub-cells or sub-faces; both have the same
  /// lattice and topology.
  template <int dim>
  void
  add(Field<dim> &field, const double factor, const Field<dim> &change);

  /// velocity += factor * acceleration on owned faces and all pieces.
  template <int dim>
  void
  add(Velocity<dim> &velocity, const double factor, const Velocity<dim> &acceleration);

  /// velocity *= factor on owned faces and all pieces.
  template <int dim>
  void
  scale(Velocity<dim> &velocity, const double factor);

  /// Exchange one ghost layer of each component. Collective.
  template <int dim>
  void
  exchange(Velocity<dim> &velocity);
} // namespace undine

#endif
