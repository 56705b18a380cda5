// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/single_physics.h>

namespace undine
{
  template <int dim>
  FluidAlone<dim>::FluidAlone(const Models<dim> &models, TimingTree &timing)
    : timing(timing)
    , fluid_side(models, timing)
    , projection(*models.fluid)
  {
  }


  template <int dim>
  void
  FluidAlone<dim>::initialize(State<dim> &state, const double dt, Report &report)
  {
    fluid_side.initialize(state, projection, dt, report);
  }


  template <int dim>
  void
  FluidAlone<dim>::step(State<dim> &state, Report &report)
  {
    const auto timed    = timing.section("fluid");
    const auto fluid    = fluid_side.predict(state, report.dt);
    const auto geometry = fluid_side.geometry();

    typename Projection<dim>::Report projected;
    {
      const auto phase = timing.section("project");
      projected        = projection.project(state.fluid,
                                     fluid->flow.velocity(),
                                     fluid->time + fluid->dt,
                                     fluid->dt,
                                     geometry ? geometry->pushed(fluid->dt) : PushedVolume());
    }
    report.linear_iterations += projected.iterations;
    fluid_side.finish(*fluid, state, report, projected.divergence);
  }


  template class FluidAlone<2>;
  template class FluidAlone<3>;
} // namespace undine
