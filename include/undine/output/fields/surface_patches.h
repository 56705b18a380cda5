// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_fields_surface_patches_h
#define undine_output_fields_surface_patches_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>
#include <undine/output/fields/patches.h>

namespace undine
{
  /// The whole surfaces of obstacles where the fluid's fields met them last: segments or triangles
  /// with their velocity [m/s] and the index of the obstacle. All on the first rank. Collective.
  template <int dim>
  Patches<dim - 1, dim>
  obstacle_patches(const Models<dim> &models, const State<dim> &state);

  /// The surfaces of bodies and obstacles as cells cut them, as far as they are in the domain:
  /// velocity [m/s], index of the body or obstacle, and the reduced pressure [Pa] of the component
  /// of the fluid that each piece faces (zero if none: bodies in contact). Both sides of a thin
  /// body are there. Collective.
  template <int dim>
  Patches<dim - 1, dim>
  cut_surface_patches(const Models<dim> &models, const State<dim> &state);
} // namespace undine

#endif
