// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/coupled/step/one_way.h>

namespace undine
{
  template <int dim>
  OneWay<dim>::OneWay(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing)
    : Physics<dim>(models.communicator())
    , models(models)
    , budget(budget)
    , timing(timing)
    , fluid_side(models, budget, timing)
    , solid_side(models, budget, timing)
    , projection(*models.fluid)
    , at_start(start_of_bodies(*models.solid))
  {
    at_start.velocity = 0;
  }


  template <int dim>
  void
  OneWay<dim>::initialize(State<dim> &state, const double dt, Report &report)
  {
    solid_side.initialize(state, dt, report);
    const auto start = state.solid;
    if (models.direction == Direction::fluid_to_body)
      state.solid = at_start;
    fluid_side.initialize(state, projection, dt, report);
    state.solid = start;
    solid_side.add_columns(report, state, state.clock.time);
  }


  template <int dim>
  void
  OneWay<dim>::solve_stage(State<dim> &state, const Stage &stage, Report &report)
  {
    budget.begin_stage(stage);
    Half half = models.direction == Direction::fluid_to_body
                  ? fluid_then_body(state, stage, report)
                  : body_then_fluid(state, stage, report);
    if (budget.is_on())
      book(half, state);
    report.linear_iterations += half.projected.iterations;
    fluid_side.finish(*half.fluid, state, report, half.projected.divergence);
    budget.end_stage();
    solid_side.finish(state, stage, half.solid, report);
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  OneWay<dim>::loads_on_surfaces(const State<dim> &state, const double time) const
  {
    if (models.direction == Direction::body_to_fluid)
      return {};
    return fluid_side.loads_on_surfaces(state, time);
  }


  template <int dim>
  typename OneWay<dim>::Half
  OneWay<dim>::fluid_then_body(State<dim> &state, const Stage &stage, Report &report)
  {
    Half       half;
    const auto moving = state.solid;
    state.solid       = at_start;
    half.fluid        = fluid_side.predict(state, stage, report);
    state.solid       = moving;

    const auto &geometry = *fluid_side.geometry();
    project(half, state, geometry.surface_velocities());
    half.exchange.on_bodies = geometry.pressure_forces(state.fluid.pressure);
    half.exchange.at_rest   = geometry.other_forces(half.fluid->gravity, half.fluid->end);
    auto forces             = models.solid->vector();
    models.surface->add_to_bodies(forces, half.exchange.on_bodies);
    models.surface->add_to_bodies(forces, half.exchange.at_rest);
    if (half.fluid->friction)
      {
        half.exchange.friction = half.fluid->friction->on_nodes;
        models.surface->add_to_bodies(forces, half.exchange.friction);
      }

    solid_side.start(state, stage);
    advance_bodies(half, state, stage, forces);
    half.exchange.velocities = geometry.surface_velocities();
    return half;
  }


  template <int dim>
  typename OneWay<dim>::Half
  OneWay<dim>::body_then_fluid(State<dim> &state, const Stage &stage, Report &report)
  {
    Half half;
    solid_side.start(state, stage);
    half.fluid = fluid_side.predict(state, stage, report);
    advance_bodies(half, state, stage, {});
    half.exchange.on_bodies  = Vectors(models.surface->surface().n_nodes());
    half.exchange.at_rest    = half.exchange.on_bodies;
    half.exchange.velocities = models.surface->with_bodies(
      state.solid.velocity, fluid_side.geometry()->surface_velocities());
    project(half, state, half.exchange.velocities);
    return half;
  }


  /// Under nodal `forces` [N]; empty: none.
  template <int dim>
  void
  OneWay<dim>::advance_bodies(Half                                   &half,
                              State<dim>                             &state,
                              const Stage                            &stage,
                              const typename SolidModel<dim>::Vector &forces)
  {
    auto increment = state.solid.displacement;
    half.solid     = solid_side.advance(state, stage, forces);
    increment.sadd(-1, 1, state.solid.displacement);
    solid_side.end(state, stage);
    half.exchange.increment =
      models.surface->with_bodies(increment, Vectors(models.surface->surface().n_nodes()));
  }


  /// Between surfaces that move with `velocities`. Throws SolveError where bodies close off fluid,
  /// whose volume their motion does not conserve.
  template <int dim>
  void
  OneWay<dim>::project(Half &half, State<dim> &state, const Vectors &velocities)
  try
    {
      const auto phase = timing.section("project");
      half.projected =
        projection.project(state.fluid,
                           half.fluid->tracer.velocity(),
                           half.fluid->end,
                           half.fluid->dt,
                           fluid_side.geometry()->swept_volume_flux(velocities, half.fluid->dt));
    }
  catch (const NoOutletError &error)
    {
      throw SolveError(std::string(error.what()) +
                       " If bodies close this part off, a coupling in one direction has no "
                       "solution. Try: 'Coupling / Direction = two-way'.");
    }


  template <int dim>
  void
  OneWay<dim>::book(Half &half, const State<dim> &state)
  {
    const auto phase              = timing.section("measure");
    half.exchange.by_fluid        = fluid_side.geometry()->pressure_forces(state.fluid.pressure);
    half.exchange.by_surface_flux = half.exchange.by_fluid;
    budget.add(half.projected.balance(*models.fluid, state.fluid),
               half.projected.before,
               state.fluid.velocity);
    budget.add(half.exchange);
    budget.add(*half.solid.balance);
  }


  template class OneWay<2>;
  template class OneWay<3>;
} // namespace undine
