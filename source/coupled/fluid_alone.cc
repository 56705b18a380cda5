// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/single_physics.h>
#include <undine/fluid/fluid_quantities.h>

namespace undine
{
  template <int dim>
  FluidAlone<dim>::FluidAlone(const Models<dim> &models, TimingTree &timing)
    : models(models)
    , model(*models.fluid)
    , timing(timing)
    , projection(model)
  {
    if (models.surface)
      geometry = std::make_unique<FluidGeometry<dim>>(models);
  }


  template <int dim>
  void
  FluidAlone<dim>::place_obstacles(const State<dim> &state, const double dt)
  {
    if (!geometry)
      return;
    const auto   phase = timing.section("cut cells");
    const double time  = state.clock.time;
    const auto   now   = models.surface->positions(state.solid, time);
    geometry->place(state.surface_positions.empty() ? now : state.surface_positions,
                    now,
                    models.surface->velocities(state.solid, time, dt));
  }


  template <int dim>
  void
  FluidAlone<dim>::initialize(State<dim> &state, const double dt, Report &report)
  {
    place_obstacles(state, dt);
    const auto bodies = geometry ? geometry->bodies() : typename Flow<dim>::Bodies();
    state.fluid       = model.initial_state(bodies.open_parts);
    for (const auto &effect : models.effects)
      effect->initialize(model, state.fluid);
    const auto projected = projection.make_divergence_free(
      state.fluid, state.clock.time, geometry ? geometry->pushed(dt) : PushedVolume());
    report.linear_iterations += projected.iterations;
    if (geometry)
      {
        report.note = geometry->news();
        geometry->accept();
        state.surface_positions = models.surface->positions(state.solid, state.clock.time);
      }
    add_columns(report, state.fluid, projected.divergence, state.clock.time);
  }


  template <int dim>
  void
  FluidAlone<dim>::step(State<dim> &state, Report &report)
  {
    const auto timed = timing.section("fluid");
    place_obstacles(state, report.dt);
    FluidStep<dim> fluid(model,
                         state.fluid,
                         models.environment().gravity,
                         state.clock.time,
                         report.dt,
                         timing,
                         geometry ? geometry->bodies() : typename Flow<dim>::Bodies());
    {
      const auto phase = timing.section("transport");
      for (const auto &effect : models.effects)
        effect->transport(fluid);
      fluid.settle();
    }
    {
      const auto phase = timing.section("accelerate");
      for (const auto &effect : models.effects)
        effect->accelerate(fluid);
    }
    {
      const auto phase = timing.section("diffuse");
      for (const auto &effect : models.effects)
        effect->diffuse(fluid);
    }
    typename Projection<dim>::Report projected;
    {
      const auto phase = timing.section("project");
      projected        = projection.project(state.fluid,
                                     fluid.flow.velocity(),
                                     fluid.time + fluid.dt,
                                     fluid.dt,
                                     geometry ? geometry->pushed(fluid.dt) : PushedVolume());
    }
    fluid.finish();
    if (geometry)
      {
        report.note = geometry->news();
        geometry->accept();
        state.surface_positions = models.surface->positions(state.solid, fluid.time);
      }
    report.linear_iterations += fluid.linear_iterations + projected.iterations;
    const auto phase = timing.section("measure");
    add_columns(report, state.fluid, projected.divergence, fluid.time + fluid.dt);
  }


  template <int dim>
  void
  FluidAlone<dim>::add_columns(Report                &report,
                               const FluidState<dim> &state,
                               const double           divergence,
                               const double           time) const
  {
    const auto append = [&](const Columns &more) {
      report.columns.insert(report.columns.end(), more.begin(), more.end());
    };
    append(fluid_columns(model, state, divergence));
    for (const auto &effect : models.effects)
      append(effect->columns(model, state, time));
    if (geometry)
      append(geometry->columns(state.pressure, models.environment().gravity, time));
  }


  template class FluidAlone<2>;
  template class FluidAlone<3>;
} // namespace undine
