// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/node_masses.h>
#include <undine/coupled/immersed/viscous_coupling.h>
#include <undine/operators/make_no_slip_surfaces.h>

#include <cmath>

namespace undine
{
  namespace
  {
    template <int dim>
    bool
    has_no_slip_surfaces(const Models<dim> &models)
    {
      return models.fluid && models.surface && models.has_friction();
    }
  } // namespace


  template <int dim>
  ViscousCoupling<dim>::ViscousCoupling(const Models<dim> &models)
    : models(models)
    , masses(has_no_slip_surfaces(models) ? node_masses(models) : Vectors())
    , last_forces(has_no_slip_surfaces(models) ? models.surface->surface().n_nodes() : 0)
  {
  }


  template <int dim>
  std::shared_ptr<const NoSlipSurfaces<dim>>
  ViscousCoupling<dim>::walls(const FluidGeometry<dim> &geometry)
  {
    if (known_surfaces && cut_by == geometry.bodies().topology)
      return known_surfaces;
    auto found     = make_no_slip_surfaces(models.fluid->grid(),
                                       geometry.cut_cells(),
                                       geometry.cut_topology(),
                                       geometry.boundary_flux(),
                                       {models.surface->surface(), geometry.surface_positions()});
    found.masses   = masses;
    cut_by         = geometry.bodies().topology;
    known_surfaces = std::make_shared<const NoSlipSurfaces<dim>>(std::move(found));
    return known_surfaces;
  }


  template <int dim>
  typename ViscousCoupling<dim>::Vectors
  ViscousCoupling<dim>::start(const State<dim>         &state,
                              const FluidGeometry<dim> &geometry,
                              const double              dt)
  {
    started     = geometry.surface_velocities();
    auto result = started;
    if (!state.other_forces.empty())
      for (std::size_t node = 0; node < masses.size(); ++node)
        for (unsigned int axis = 0; axis < dim; ++axis)
          if (std::isfinite(masses[node][axis]))
            result[node][axis] += dt * state.other_forces[node][axis] / masses[node][axis];
    return result;
  }


  template <int dim>
  void
  ViscousCoupling<dim>::end(State<dim> &state, const FluidStage<dim> &fluid)
  {
    last_forces = fluid.friction->on_nodes;
    if (!models.solid)
      return;
    const auto now     = models.surface->with_bodies(state.solid.velocity, started);
    state.other_forces = Vectors(now.size());
    for (std::size_t node = 0; node < masses.size(); ++node)
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const double mass   = masses[node][axis];
          const double change = now[node][axis] - started[node][axis];
          state.other_forces[node][axis] =
            (std::isfinite(mass) ? mass * change / fluid.dt : 0) - last_forces[node][axis];
        }
  }


  template class ViscousCoupling<2>;
  template class ViscousCoupling<3>;
} // namespace undine
