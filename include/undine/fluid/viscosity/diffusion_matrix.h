// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_diffusion_matrix_h
#define undine_fluid_viscosity_diffusion_matrix_h

#include <undine/fluid/viscosity/diffusion_problem.h>
#include <undine/fluid/viscosity/diffusion_solver.h>

#include <vector>

namespace undine
{
  /// The step of ImplicitDiffusion with a matrix, which is kept until h changes.
  template <int dim>
  class DiffusionMatrix
  {
  public:
    /// `problem` must outlive it.
    explicit DiffusionMatrix(const DiffusionProblem<dim> &problem);

    /// s* in `field` becomes s^{n+1} at `time` = t^{n+1}, `dt` = h [s]; `diffusion_number`: the
    /// largest h nu / dx^2. Returns the number of iterations. Throws SolveError. Collective.
    unsigned int
    step(Field<dim> &field, double time, double dt, double diffusion_number);

    /// Memory of the matrix and, as far as deal.II reports it, of the preconditioner on this rank
    /// [bytes].
    std::size_t
    memory_consumption() const;

  private:
    /// A row of the matrix; the first column is the diagonal.
    struct Row
    {
      std::vector<dealii::types::global_dof_index> columns;
      std::vector<double>                          values;
    };

    void
    collect(Row &row, const GridIndex<dim> &index, double dt) const;

    void
    assemble(double dt, double diffusion_number);

    /// V s* + h nu k_b s_b, in the order of Field::owned_values(). One ghost layer must be up to
    /// date.
    std::vector<double>
    right_side(const Field<dim> &field, double time) const;

    const DiffusionProblem<dim> &problem;
    double                       assembled_dt = 0; ///< [s]
    DiffusionSolver              solver;
  };
} // namespace undine

#endif
