// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_rigid_motions_h
#define undine_solid_mesh_rigid_motions_h

#include <undine/solid/mesh/solid_model.h>

#include <Epetra_MultiVector.h>

namespace undine
{
  /// The translations and infinitesimal rotations of the bodies where they are now (3 vectors in
  /// 2D, 6 in 3D), zero at fixed degrees of freedom: the near-null space of the stiffness.
  template <int dim>
  Epetra_MultiVector
  rigid_motions(const SolidModel<dim>                       &model,
                const dealii::TrilinosWrappers::MPI::Vector &displacement);
} // namespace undine

#endif
