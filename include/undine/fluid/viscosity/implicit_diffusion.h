// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_implicit_diffusion_h
#define undine_fluid_viscosity_implicit_diffusion_h

#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/convection/dual_fluxes.h>
#include <undine/fluid/model/fluid_model.h>
#include <undine/fluid/viscosity/diffusion_solver.h>
#include <undine/fluid/viscosity/neighbour_equations.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace undine
{
  /// One implicit Euler step of ds/dt = nu Laplace(s) for a field on a lattice:
  ///
  ///     (V + h nu K) s^{n+1} = V s* + h nu k_b s_b
  ///
  /// V: volumes around the points; K: areas over distances between neighbours; Dirichlet boundaries
  /// at half a cell. Faces whose velocity is prescribed keep the value they have. Symmetric and
  /// positive definite. Solved by relaxation (NeighbourEquations); where a step reaches over many
  /// cells, h nu >= 30 dx^2, by conjugate gradients with algebraic multigrid (DiffusionSolver), for
  /// which there is a matrix that is kept until h changes. A component of the velocity can be
  /// carried by the flow in the same step, in flux form (F13), as in ImmersedViscousTerm.
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

    /// The same by relaxation, with convection by `fluxes`, where nothing is cut and nothing moves,
    /// unless they are nullptr. Returns the number of sweeps; nothing, and leaves the field as it
    /// is, where relaxation would take long. Collective.
    std::optional<unsigned int>
    relax(Field<dim> &field, const double time, const double dt, const DualFluxes<dim> *fluxes);

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

    /// Along one direction, from the point before the first owned one on.
    struct Distances
    {
      int                 first;
      std::vector<double> extents; ///< of the volumes around points [m]
      std::vector<double> links;   ///< 1 / distance to the next point [1/m]; 0: there is none

      double
      extent(const int index) const
      {
        return extents[index - first];
      }

      double
      link(const int index) const
      {
        return links[index - first];
      }
    };

    void
    collect(Row &row, const GridIndex<dim> &index, const double dt) const;

    void
    assemble(const double dt);

    unsigned int
    solve_with_matrix(Field<dim> &field, const double time, const double dt);

    /// h nu / dx^2 at its largest.
    double
    diffusion_number(const double dt) const;

    /// V s* + h nu k_b s_b, in the order of Field::owned_values(). One ghost layer must be up to
    /// date.
    std::vector<double>
    right_side(const Field<dim> &field, const double time) const;

    Distances
    distances(const unsigned int direction) const;

    void
    couple(const unsigned int direction, const double dt, const DualFluxes<dim> *fluxes);

    void
    fill_points(const Field<dim> &field);

    void
    add_sides(const double time, const double dt);

    void
    add_entering(const double dt, const DualFluxes<dim> &fluxes);

    void
    keep_prescribed(const Field<dim> &field);

    const FluidModel<dim>              &model;
    std::shared_ptr<const Lattice<dim>> lattice;
    const BoundaryCondition<dim>       &condition;
    double                              diffusivity;
    std::array<Distances, dim>          along;
    double                              largest_number;   ///< diffusion_number() / (h nu) [1/m^2]
    double                              assembled_dt = 0; ///< [s]
    DiffusionSolver                     solver;
    std::unique_ptr<NeighbourEquations<dim>> equations; ///< once they are needed
  };
} // namespace undine

#endif
