// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_flux_matrix_h
#define undine_operators_flux_matrix_h

#include <undine/fluid/grid/pressure_numbers.h>
#include <undine/operators/boundary_flux.h>
#include <undine/operators/cut_topology.h>
#include <undine/surface/immersed_surface.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace undine
{
  /// BoundaryFlux as a matrix [m^(dim-1)]: its rows are the fluid's pressures, its columns the
  /// bodies' degrees of freedom. Columns of fixed ones are empty. Collective.
  template <int dim>
  void
  build_flux_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix,
                    const BoundaryFlux<dim>                &boundary_flux,
                    const CutTopology<dim>                 &parts,
                    const PressureNumbers<dim>             &numbers,
                    const ImmersedSurface<dim>             &surface,
                    const SolidModel<dim>                  &solid);

  /// The rows of that matrix on this rank that are not empty: pressures to which bodies yield. Not
  /// collective.
  std::vector<dealii::types::global_dof_index>
  filled_rows(const dealii::TrilinosWrappers::SparseMatrix &matrix);
} // namespace undine

#endif
