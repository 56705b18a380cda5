// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/viscosity/implicit_diffusion.h>

#include <utility>

namespace undine
{
  template <int dim>
  ImplicitDiffusion<dim>::ImplicitDiffusion(const FluidModel<dim>              &model,
                                            std::shared_ptr<const Lattice<dim>> lattice,
                                            const BoundaryCondition<dim>       &condition,
                                            const double                        diffusivity)
    : problem{model, std::move(lattice), condition, diffusivity}
    , largest_rate(largest_diffusion_rate(model.grid(), *problem.lattice))
  {
  }


  template <int dim>
  std::optional<unsigned int>
  ImplicitDiffusion<dim>::relax(Field<dim>            &field,
                                const double           time,
                                const double           dt,
                                const DualFluxes<dim> *fluxes)
  {
    if (diffusion_number(dt) >= DiffusionSolver::far)
      return {};
    if (!relaxation)
      relaxation = std::make_unique<RelaxedDiffusion<dim>>(problem);
    return relaxation->step(field, time, dt, fluxes);
  }


  template <int dim>
  unsigned int
  ImplicitDiffusion<dim>::step(Field<dim> &field, const double time, const double dt)
  {
    if (problem.diffusivity == 0)
      return 0;
    if (const auto n_sweeps = relax(field, time, dt, nullptr))
      return *n_sweeps;
    if (!matrix)
      matrix = std::make_unique<DiffusionMatrix<dim>>(problem);
    return matrix->step(field, time, dt, diffusion_number(dt));
  }


  template <int dim>
  std::size_t
  ImplicitDiffusion<dim>::memory_consumption() const
  {
    return (matrix ? matrix->memory_consumption() : 0) +
           (relaxation ? relaxation->memory_consumption() : 0);
  }


  template class ImplicitDiffusion<2>;
  template class ImplicitDiffusion<3>;
} // namespace undine
