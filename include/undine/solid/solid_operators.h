// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_solid_operators_h
#define undine_solid_solid_operators_h

#include <undine/solid/solid_environment.h>
#include <undine/solid/solid_model.h>

namespace undine
{
  /// The terms of the bodies' equations. Vectors named displacement or velocity are over the
  /// locally owned degrees of freedom, as is every result. Nothing here knows of prescribed
  /// motions: rows of fixed degrees of freedom are as full as any other, which is where reactions
  /// are read. All functions are collective; those of a displacement throw SolveError, on all
  /// ranks, that names body and place where a material point is inverted. @{

  /// M_ij = int rho N_i . N_j dX [kg].
  template <int dim>
  typename SolidModel<dim>::Matrix
  mass_matrix(const SolidModel<dim> &model);

  /// K_i(d) = int P(I + grad d) : grad N_i dX [N].
  template <int dim>
  typename SolidModel<dim>::Vector
  internal_forces(const SolidModel<dim>                       &model,
                  const dealii::TrilinosWrappers::MPI::Vector &displacement);

  /// A += factor K'(d) [N/m].
  template <int dim>
  void
  add_tangent(dealii::TrilinosWrappers::SparseMatrix      &A,
              const SolidModel<dim>                       &model,
              const dealii::TrilinosWrappers::MPI::Vector &displacement,
              double                                       factor);

  /// int W dX [J].
  template <int dim>
  double
  elastic_energy(const SolidModel<dim>                       &model,
                 const dealii::TrilinosWrappers::MPI::Vector &displacement);

  /// Forces that do not depend on the displacement [N]: gravity, loads per volume, tractions.
  template <int dim>
  typename SolidModel<dim>::Vector
  dead_loads(const SolidModel<dim> &model, const SolidEnvironment<dim> &environment, double time);

  /// Is any boundary loaded by a follower pressure? Its tangent is not symmetric.
  template <int dim>
  bool
  has_pressure_loads(const SolidModel<dim> &model);

  /// f_i(d) = - int p cof(F) n . N_i dA over the boundaries with a follower pressure p [N].
  template <int dim>
  typename SolidModel<dim>::Vector
  pressure_loads(const SolidModel<dim>                       &model,
                 const dealii::TrilinosWrappers::MPI::Vector &displacement,
                 double                                       time);

  /// A += factor df/dd of these loads [N/m].
  template <int dim>
  void
  add_pressure_tangent(dealii::TrilinosWrappers::SparseMatrix      &A,
                       const SolidModel<dim>                       &model,
                       const dealii::TrilinosWrappers::MPI::Vector &displacement,
                       double                                       time,
                       double                                       factor);

  /// The norm that rounding gives K(d) [N].
  template <int dim>
  double
  rounding_of_forces(const SolidModel<dim>                       &model,
                     const dealii::TrilinosWrappers::MPI::Vector &displacement);
  /// @}
} // namespace undine

#endif
