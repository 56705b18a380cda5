// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/viscous_coupling.h>
#include <undine/operators/make_no_slip_surfaces.h>
#include <undine/solid/assembly/mass_matrix.h>

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
    , last_forces(has_no_slip_surfaces(models) ? models.surface->surface().n_nodes() : 0)
  {
    if (!moves_bodies())
      return;
    mass.copy_from(mass_matrix(*models.solid));
    solvers.emplace(*models.solid);
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
    cut_by         = geometry.bodies().topology;
    known_surfaces = std::make_shared<const NoSlipSurfaces<dim>>(std::move(found));
    return known_surfaces;
  }


  template <int dim>
  bool
  ViscousCoupling<dim>::moves_bodies() const
  {
    return models.solid && has_no_slip_surfaces(models) && models.direction == Direction::two_way;
  }


  template <int dim>
  void
  ViscousCoupling<dim>::keep_loads(State<dim>                   &state,
                                   const FluidGeometry<dim>     &geometry,
                                   const dealii::Tensor<1, dim> &gravity,
                                   const double                  time) const
  {
    if (!moves_bodies())
      return;
    auto &loads = state.solid.fluid_loads;
    loads       = models.solid->vector();
    models.surface->add_to_bodies(loads, geometry.pressure_forces(state.fluid.pressure));
    models.surface->add_to_bodies(loads, geometry.other_forces(gravity, time));
  }


  template <int dim>
  void
  ViscousCoupling<dim>::end(const FluidStage<dim>    &fluid,
                            const State<dim>         &state,
                            const FluidGeometry<dim> &geometry)
  {
    last_forces = fluid.friction->on_nodes;
    last_defect = 0;
    if (fluid.wall_damping.empty())
      return;
    const auto velocities =
      models.surface->with_bodies(state.solid.velocity, fluid.wall_velocities);
    const auto pressures = geometry.pressure_forces(state.fluid.pressure);
    const auto areas     = geometry.uniform_pressure_forces(1);
    // The level of the pressure, which bodies hardly feel, does not count.
    double product = 0, square = 0;
    for (unsigned int node = 0; node < models.surface->n_body_nodes(); ++node)
      {
        product += pressures[node] * areas[node];
        square += areas[node].norm_square();
      }
    const double level   = square > 0 ? product / square : 0;
    double       missing = 0, all = 0;
    for (unsigned int node = 0; node < models.surface->n_body_nodes(); ++node)
      {
        const auto change = velocities[node] - fluid.wall_velocities[node];
        for (unsigned int d = 0; d < dim; ++d)
          missing += fluid.wall_damping[node][d] * std::abs(change[d]);
        all += last_forces[node].norm() + (pressures[node] - level * areas[node]).norm();
      }
    last_defect = all > 0 ? missing / all : 0;
  }


  template <int dim>
  std::unique_ptr<BodyImpedance<dim>>
  ViscousCoupling<dim>::impedance(const State<dim>            &state,
                                  const FluidGeometry<dim>    &geometry,
                                  const SolidEnvironment<dim> &environment,
                                  const Stage                 &stage,
                                  const double                 viscosity,
                                  TimingTree                  &timing)
  {
    if (!moves_bodies())
      return nullptr;
    return std::make_unique<LinearisedBodies<dim>>(
      models, mass, environment, geometry, state, stage, viscosity, timing, *solvers);
  }


  template class ViscousCoupling<2>;
  template class ViscousCoupling<3>;
} // namespace undine
