// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_pressure_matrix_h
#define undine_fluid_pressure_pressure_matrix_h

#include <undine/fluid/grid/pressure_numbers.h>
#include <undine/fluid/model/fluid_model.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <vector>

namespace undine
{
  /// Build L = D (rho V)^-1 D^T (F4), face by face: a face or piece between two pressures adds
  /// a^2/(rho V) to the diagonal of each and couples them by minus that; one on an opening adds
  /// a^2/(rho V) to the diagonal of the pressure inside. Collective.
  ///
  /// A region without opening leaves a constant free. One pressure of each such region is named in
  /// `pinned` by the rank that owns it, and its diagonal is doubled: for right sides whose entries
  /// sum to zero over the region the solution is one of the original equation, the one with zero
  /// there. A region that is one component without open piece gets the diagonal 1.
  template <int dim>
  void
  build_pressure_matrix(dealii::TrilinosWrappers::SparseMatrix                   &matrix,
                        const FluidModel<dim>                                    &model,
                        const PressureNumbers<dim>                               &numbers,
                        const std::vector<typename PressureNumbers<dim>::Number> &pinned);
} // namespace undine

#endif
