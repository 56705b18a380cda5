// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/base/multigrid/cell_preconditioner.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_model.h>

namespace undine
{
  void
  PressureSolverSettings::add_options(const Options &options)
  {
    options.add(
      "Divergence tolerance",
      divergence_tolerance,
      "",
      Allowed::between(1e-14, 1e-2),
      "Largest |div v| dx in any cell after a step, over the largest speed in the fluid.");
    options.add("Maximum iterations",
                maximum_iterations,
                "",
                Allowed::between(1, 1e6),
                "Of conjugate gradients; the step fails if they do not suffice.");
    options.add("Multigrid",
                multigrid,
                "",
                Allowed::one_of(Registry<CellPreconditioner>::instance().names()),
                "For the pressures of projections: on blocks of cells, "
                "or by smoothed aggregation (Trilinos ML).");
  }


  template <int dim>
  typename FluidModel<dim>::Parameters
  FluidModel<dim>::read(const Options &scene)
  {
    const auto fluid = scene.section("Fluid");
    Parameters parameters;
    const auto domain = scene.section("Domain");
    domain.attempt([&] { parameters.planes = read_planes<dim>(domain); });
    fluid.require(
      "Density", parameters.density, "kg/m^3", Allowed::positive(), "Mass per volume, constant.");
    fluid.add("Initial velocity",
              parameters.initial_velocity,
              "m/s",
              Allowed::constant_in_time(),
              "At the start; made divergence-free before the first step.");
    parameters.boundaries = read_boundaries<dim>(fluid.section("Boundaries"));
    parameters.pressure_solver.add_options(fluid.section("Pressure solver"));
    return parameters;
  }


  template <int dim>
  FluidModel<dim>::FluidModel(const Options &scene, const MPI_Comm communicator)
    : FluidModel(scene, communicator, read(scene))
  {
  }


  template <int dim>
  FluidModel<dim>::FluidModel(const Options    &scene,
                              const MPI_Comm    communicator,
                              const Parameters &parameters_)
    : parameters(parameters_)
    , mac_grid(communicator, parameters.planes, periodic_axes<dim>(parameters.boundaries))
    , boundary_map(scene.section("Fluid").section("Boundaries"), parameters.boundaries, mac_grid)
  {
  }


  template <int dim>
  void
  FluidModel<dim>::declare(const Options &scene)
  {
    read(scene);
  }


  template <int dim>
  const MacGrid<dim> &
  FluidModel<dim>::grid() const
  {
    return mac_grid;
  }


  template <int dim>
  const BoundaryMap<dim> &
  FluidModel<dim>::boundaries() const
  {
    return boundary_map;
  }


  template <int dim>
  double
  FluidModel<dim>::density() const
  {
    return parameters.density;
  }


  template <int dim>
  const PressureSolverSettings &
  FluidModel<dim>::pressure_solver() const
  {
    return parameters.pressure_solver;
  }


  template <int dim>
  FluidState<dim>
  FluidModel<dim>::initial_state(const std::shared_ptr<const FluidTopology<dim>> &topology) const
  {
    FluidState<dim> state;
    state.pressure = Field<dim>(mac_grid.cells(), topology);
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        auto &component          = state.velocity[axis];
        component                = Field<dim>(mac_grid.faces(axis), topology);
        state.acceleration[axis] = component;
        state.change[axis]       = component;
        if (!parameters.initial_velocity.is_zero())
          for_each_value(component, [&](double &value, const auto &place, const auto &) {
            value = parameters.initial_velocity.value(place, 0, axis);
          });
        set_means(component, mac_grid);
      }
    return state;
  }


  template class FluidModel<2>;
  template class FluidModel<3>;
} // namespace undine
