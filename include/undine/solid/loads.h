// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_loads_h
#define undine_solid_loads_h

#include <undine/solid/solid_environment.h>
#include <undine/solid/solid_model.h>

namespace undine
{
  /// Nodal forces of the loads that a scene puts on its bodies, over the locally owned degrees of
  /// freedom, as of the displacement. Collective. @{

  /// Forces that do not depend on the displacement [N]: gravity rho g, loads per volume, tractions.
  template <int dim>
  dealii::TrilinosWrappers::MPI::Vector
  dead_loads(const SolidModel<dim> &model, const SolidEnvironment<dim> &environment, double time);

  /// Is any boundary loaded by a follower pressure? Its tangent need not be symmetric.
  template <int dim>
  bool
  has_pressure_loads(const SolidModel<dim> &model);

  /// f_i(d) = - int p cof(F) n . N_i dA over the boundaries with a follower pressure p [N], with n
  /// the outward normal at rest.
  template <int dim>
  dealii::TrilinosWrappers::MPI::Vector
  pressure_loads(const SolidModel<dim>                       &model,
                 const dealii::TrilinosWrappers::MPI::Vector &displacement,
                 double                                       time);

  /// df/dd of these loads [N/m].
  template <int dim>
  dealii::TrilinosWrappers::SparseMatrix
  pressure_stiffness(const SolidModel<dim>                       &model,
                     const dealii::TrilinosWrappers::MPI::Vector &displacement,
                     double                                       time);
  /// @}
} // namespace undine

#endif
