// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_internal_forces_h
#define undine_solid_assembly_internal_forces_h

#include <undine/solid/mesh/solid_model.h>

namespace undine
{
  /// Forces, stiffness and energy of the material of all bodies for a displacement over the locally
  /// owned degrees of freedom. Rows of fixed degrees of freedom are as full as any other: reactions
  /// are read there. Collective. Throws SolveError on all ranks, naming body and place, where a
  /// point is inverted. @{

  /// Internal forces K_i(d) = int P(I + grad d) : grad N_i dX [N] (S4).
  template <int dim>
  dealii::TrilinosWrappers::MPI::Vector
  internal_forces(const SolidModel<dim>                       &model,
                  const dealii::TrilinosWrappers::MPI::Vector &displacement);

  /// Tangent stiffness K'(d) = dK/dd [N/m] (S5), exact and symmetric.
  template <int dim>
  dealii::TrilinosWrappers::SparseMatrix
  internal_stiffness(const SolidModel<dim>                       &model,
                     const dealii::TrilinosWrappers::MPI::Vector &displacement);

  /// Forces of the viscous stress P_v (S15) of all bodies for eta = 1 s, int P_v(d, u) : grad N_i
  /// dX [N]: their work, this times u, is never negative.
  template <int dim>
  dealii::TrilinosWrappers::MPI::Vector
  viscous_forces(const SolidModel<dim>                       &model,
                 const dealii::TrilinosWrappers::MPI::Vector &displacement,
                 const dealii::TrilinosWrappers::MPI::Vector &velocity);

  /// Their exact derivative [N/m], see CellForces::viscous_tangent() for the factors.
  template <int dim>
  dealii::TrilinosWrappers::SparseMatrix
  viscous_stiffness(const SolidModel<dim>                       &model,
                    const dealii::TrilinosWrappers::MPI::Vector &displacement,
                    const dealii::TrilinosWrappers::MPI::Vector &velocity,
                    double                                       displacement_factor,
                    double                                       velocity_factor);

  /// Elastic energy int W dX [J].
  template <int dim>
  double
  elastic_energy(const SolidModel<dim>                       &model,
                 const dealii::TrilinosWrappers::MPI::Vector &displacement);
  /// @}

  /// What rounding may leave in the nodes [N] of forces K(d) in balance, |d| being at most `size`
  /// [m]: strains are exact to the rounding of d / (cell width) and of 1, stresses to that times
  /// the material's p-wave modulus.
  template <int dim>
  dealii::TrilinosWrappers::MPI::Vector
  rounding_of_forces(const SolidModel<dim> &model, double size);
} // namespace undine

#endif
