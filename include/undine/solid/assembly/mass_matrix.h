// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_mass_matrix_h
#define undine_solid_assembly_mass_matrix_h

#include <undine/solid/mesh/solid_model.h>

namespace undine
{
  /// The mass matrix M_ij = int rho N_i . N_j dX [kg] (S3), with the rows of fixed degrees of
  /// freedom. Collective.
  template <int dim>
  dealii::TrilinosWrappers::SparseMatrix
  mass_matrix(const SolidModel<dim> &model);
} // namespace undine

#endif
