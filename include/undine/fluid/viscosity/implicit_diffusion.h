// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_implicit_diffusion_h
#define undine_fluid_viscosity_implicit_diffusion_h

#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/model/fluid_model.h>
#include <undine/fluid/viscosity/diffusion_solver.h>

#include <memory>
#include <vector>

namespace undine
{
  /// One implicit Euler step of ds/dt = nu Laplace(s) for a field on a lattice:
  ///
  ///     (V + h nu K) s^{n+1} = V s* + h nu k_b s_b
  ///
  /// V: volumes around the points; K: areas over distances between neighbours; Dirichlet boundaries
  /// at half a cell. Faces whose velocity is prescribed keep the value they have. Symmetric and
  /// positive definite; conjugate gradients with symmetric Gauss-Seidel or, for h nu >= 30 dx^2,
  /// algebraic multigrid (DiffusionSolver). The matrix is kept until h changes.
  template <int dim>
  class ImplicitDiffusion
  {
  public:
    /// `diffusivity` nu in [m^2/s]. Model and condition must outlive this.
    ImplicitDiffusion(const FluidModel<dim>              &model,
                      std::shared_ptr<const Lattice<dim>> lattice,
                      const BoundaryCondition<dim>       &condition,
                      const double                        diffusivity);

    /// s* in `field` becomes s^{n+1} at `time` = t^{n+1}, `dt` = h [s]. Returns the number of
    /// iterations. Throws SolveError. Collective.
    unsigned int
    step(Field<dim> &field, const double time, const double dt);

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
    collect(Row &row, const GridIndex<dim> &index, const double dt) const;

    void
    assemble(const double dt);

    /// Largest h nu / dx^2.
    double
    diffusion_number(const double dt) const;

    /// V s* + h nu k_b s_b, in the order of Field::owned_values(). One ghost layer must be up to
    /// date.
    std::vector<double>
    right_side(const Field<dim> &field, const double time) const;

    const FluidModel<dim>              &model;
    std::shared_ptr<const Lattice<dim>> lattice;
    const BoundaryCondition<dim>       &condition;
    double                              diffusivity;
    double                              assembled_dt = 0; ///< [s]
    DiffusionSolver                     solver;
  };
} // namespace undine

#endif
