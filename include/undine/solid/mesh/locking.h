// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_locking_h
#define undine_solid_mesh_locking_h

#include <undine/solid/mesh/solid_model.h>

#include <string>
#include <vector>

namespace undine
{
  /// Warnings about bodies that may be far too stiff: elements of degree 1 can hardly bend without
  /// changing their volume, which a Poisson's ratio above 0.45 forbids. Bodies in plane stress and
  /// laws with a volumetric part of their own (MeanDilatation) do not lock.
  template <int dim>
  std::vector<std::string>
  locking_warnings(const SolidModel<dim> &model);
} // namespace undine

#endif
