// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/parallel/algebraic_multigrid.h>

#include <deal.II/base/mpi.h>

#include <ml_utils.h>

#include <limits>

namespace undine
{
  namespace
  {
    /// Another one on each rank, or all parts of a vector would be alike.
    void
    begin_random_numbers_anew(const MPI_Comm communicator)
    {
      const auto rank = dealii::Utilities::MPI::this_mpi_process(communicator);
      ML_set_random_seed(static_cast<int>(std::numeric_limits<int>::max() / (rank + 2.)));
    }
  } // namespace


  void
  AlgebraicMultigrid::initialize(const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    AdditionalData data;
    data.elliptic              = true;
    data.aggregation_threshold = 0.02;
    data.smoother_type         = "Chebyshev";
    data.smoother_sweeps       = 2;
    begin_random_numbers_anew(matrix.get_mpi_communicator());
    PreconditionAMG::initialize(matrix, data);
  }


  void
  AlgebraicMultigrid::initialize(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                 const Teuchos::ParameterList                 &parameters)
  {
    begin_random_numbers_anew(matrix.get_mpi_communicator());
    PreconditionAMG::initialize(matrix, parameters);
  }
} // namespace undine
