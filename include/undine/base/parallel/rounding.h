// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_parallel_rounding_h
#define undine_base_parallel_rounding_h

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <limits>

namespace undine
{
  /// About the norm of what rounding makes of a matrix times x, by the sizes of the terms on its
  /// diagonal: the smallest residual that an iteration can be asked for where these cancel.
  /// Collective.
  inline double
  rounding_of_product(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                      const dealii::TrilinosWrappers::MPI::Vector  &x)
  {
    dealii::TrilinosWrappers::MPI::Vector sizes(x.locally_owned_elements(),
                                                x.get_mpi_communicator());
    for (const auto row : x.locally_owned_elements())
      sizes(row) = matrix.diag_element(row) * x(row);
    sizes.compress(dealii::VectorOperation::insert);
    return std::numeric_limits<double>::epsilon() * sizes.l2_norm();
  }
} // namespace undine

#endif
