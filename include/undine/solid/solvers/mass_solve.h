// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_solvers_mass_solve_h
#define undine_solid_solvers_mass_solve_h

#include <undine/solid/mesh/solid_model.h>

namespace undine
{
  /// The accelerations a [m/s^2] with M a = f at free degrees of freedom, and those of `fixed` at
  /// fixed ones. Collective. Throws SolveError.
  template <int dim>
  dealii::TrilinosWrappers::MPI::Vector
  solve_mass(const SolidModel<dim>                        &model,
             const dealii::TrilinosWrappers::SparseMatrix &mass,
             const dealii::TrilinosWrappers::MPI::Vector  &forces,
             const dealii::TrilinosWrappers::MPI::Vector  &fixed);
} // namespace undine

#endif
