// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_implicit_diffusion_h
#define undine_fluid_viscosity_implicit_diffusion_h

#include <undine/fluid/viscosity/diffusion_matrix.h>
#include <undine/fluid/viscosity/relaxed_diffusion.h>

#include <memory>
#include <optional>

namespace undine
{
  /// One implicit Euler step of ds/dt = nu Laplace(s) for a field on a lattice:
  ///
  ///     (V + h nu K) s^{n+1} = V s* + h nu k_b s_b
  ///
  /// V: volumes around the points; K: areas over distances between neighbours; Dirichlet boundaries
  /// at half a cell. Faces whose velocity is prescribed keep the value they have. Symmetric and
  /// positive definite. Solved by relaxation (RelaxedDiffusion); where a step reaches over many
  /// cells, h nu >= 30 dx^2, by conjugate gradients with algebraic multigrid (DiffusionMatrix). A
  /// component of the velocity can be carried by the flow in the same step, in flux form (F13), as
  /// in ImmersedViscousTerm.
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
    /// h nu / dx^2 at its largest.
    double
    diffusion_number(const double dt) const
    {
      return dt * problem.diffusivity * largest_rate;
    }

    const DiffusionProblem<dim>            problem;
    const double                           largest_rate; ///< 1 / dx^2 [1/m^2]
    std::unique_ptr<DiffusionMatrix<dim>>  matrix;       ///< nullptr: not needed so far
    std::unique_ptr<RelaxedDiffusion<dim>> relaxation;   ///< nullptr: not needed so far
  };
} // namespace undine

#endif
