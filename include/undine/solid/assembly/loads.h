// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_loads_h
#define undine_solid_assembly_loads_h

#include <undine/base/core/timing.h>
#include <undine/solid/assembly/solid_environment.h>
#include <undine/solid/mesh/solid_model.h>

#include <map>
#include <string>

namespace undine
{
  /// Nodal forces of the loads that a scene puts on its bodies (S6), over the locally owned degrees
  /// of freedom, as of the displacement. Collective. @{

  /// Forces that do not depend on the displacement [N]: gravity rho g, forces of other effects,
  /// loads per volume, tractions. `timing`, if given, gets the phases of effects.
  template <int dim>
  dealii::TrilinosWrappers::MPI::Vector
  dead_loads(const SolidModel<dim>       &model,
             const SolidEnvironment<dim> &environment,
             double                       time,
             TimingTree                  *timing = nullptr);

  /// The contribution of each effect to them, by its name [N].
  template <int dim>
  std::map<std::string, dealii::TrilinosWrappers::MPI::Vector>
  effect_loads(const SolidModel<dim> &model, const SolidEnvironment<dim> &environment, double time);

  /// Is any boundary loaded by a follower pressure? Its tangent need not be symmetric.
  template <int dim>
  bool
  has_pressure_loads(const SolidModel<dim> &model);

  /// f_i(d) = - int p F_33 cof(F) n . N_i dA over the boundaries with a follower pressure p [N],
  /// with F in the body's dimensions, n the outward normal at rest and F_33 the stretch of a plane
  /// body's thickness (Kinematics): a sheet in plane stress that gets thinner has a narrower edge.
  /// Throws SolveError on all ranks where there is no such F_33.
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
