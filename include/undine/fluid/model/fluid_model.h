// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_model_fluid_model_h
#define undine_fluid_model_fluid_model_h

#include <undine/base/options/options.h>
#include <undine/fluid/boundary/boundary_map.h>
#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/grid/mac_grid.h>
#include <undine/fluid/model/pressure_solver_settings.h>

namespace undine
{
  /// An incompressible fluid of constant density in a box: what does not change during a run.
  template <int dim>
  class FluidModel
  {
  public:
    /// Reads sections `Domain` and `Fluid` of the scene. Throws InputError. Collective.
    FluidModel(const Options &scene, const MPI_Comm communicator);

    /// Declare the parameters without building anything.
    static void
    declare(const Options &scene);

    const MacGrid<dim> &
    grid() const;

    const BoundaryMap<dim> &
    boundaries() const;

    /// [kg/m^3]
    double
    density() const;

    const PressureSolverSettings &
    pressure_solver() const;

    /// The initial velocity of the scene (not yet divergence-free), zero pressure, no scalars, on
    /// this topology of the fluid; nullptr: nothing is cut.
    FluidState<dim>
    initial_state(const std::shared_ptr<const FluidTopology<dim>> &topology = nullptr) const;

  private:
    struct Parameters
    {
      typename MacGrid<dim>::Planes planes;
      std::vector<Boundary<dim>>    boundaries;
      double                        density = 1000;
      Expression<dim, dim>          initial_velocity;
      PressureSolverSettings        pressure_solver;
    };

    static Parameters
    read(const Options &scene);

    FluidModel(const Options &scene, const MPI_Comm communicator, const Parameters &parameters);

    const Parameters       parameters;
    const MacGrid<dim>     mac_grid;
    const BoundaryMap<dim> boundary_map;
  };
} // namespace undine

#endif
