// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_multigrid_geometric_multigrid_h
#define undine_base_multigrid_geometric_multigrid_h

#include <undine/base/multigrid/coarsening.h>
#include <undine/base/multigrid/multigrid_level.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

namespace undine
{
  /// A symmetric V-cycle of multigrid for equations of cells of a grid as preconditioner. Blocks of
  /// cells are doubled on every level in the directions in which they are (about) the shortest, so
  /// that relaxation point by point serves stretched cells as well; on the coarsest level all ranks
  /// solve the same dense system, or relax if it is large. Levels are in single precision.
  class GeometricMultigrid
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// For make_cell_equations(diffusion, whole, places). Collective.
    GeometricMultigrid(const CellEquations::Matrix &diffusion,
                       const CellEquations::Matrix &whole,
                       const CellsOfUnknowns       &places);

    /// x := about A^-1 b. Collective.
    void
    vmult(Vector &x, const Vector &b) const;

    unsigned int
    n_levels() const;

    std::size_t
    memory_consumption() const;

  private:
    struct Level
    {
      std::unique_ptr<const MultigridLevel> matrix;
      std::vector<int>                      aggregates; ///< empty: the coarsest
      mutable MultigridLevel::Vector        x, b;
    };

    void
    add_level(const CellEquations &equations, std::vector<int> aggregates);

    void
    factorise(const CellEquations &coarsest);

    void
    solve_coarsest(const Level &level) const;

    /// x := about A^-1 b of the level.
    void
    cycle(unsigned int level) const;

    std::vector<Level>               levels; ///< the finest first
    dealii::LAPACKFullMatrix<double> coarsest;
    unsigned int                     first_of_coarsest = 0; ///< number of this rank's first unknown
    MPI_Comm                         communicator;
  };
} // namespace undine

#endif
