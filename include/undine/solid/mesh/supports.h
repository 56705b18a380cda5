// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_supports_h
#define undine_solid_mesh_supports_h

#include <undine/solid/mesh/solid_model.h>

#include <vector>

namespace undine
{
  /// Throws InputError, naming body and boundary, if the supports `fixed` (the fixed degrees of
  /// freedom of all ranks) make no sense:
  ///
  ///  - a clamp or a prescribed motion holds nothing that parts named before it do not hold;
  ///  - a prescribed motion does not start at the initial displacement, which would be an infinite
  ///    velocity (without inertia the body may jump: its first step goes there);
  ///  - without inertia, a body is free to move as a rigid body.
  template <int dim>
  void
  check_supports(const SolidModel<dim> &model, const std::vector<FixedDof> &fixed);
} // namespace undine

#endif
