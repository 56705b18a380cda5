// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/coupled/step/fluid_side.h>
#include <undine/coupled/step/outside_domain.h>
#include <undine/coupled/step/physics.h>
#include <undine/coupled/step/work_on_fluid.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>
#include <undine/operators/body_forces.h>
#include <undine/operators/outside_forces.h>
#include <undine/operators/static_pressure.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace undine
{
  namespace
  {
    /// a + factor b, where an empty b is zero.
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    sum(std::vector<dealii::Tensor<1, dim>>        a,
        const std::vector<dealii::Tensor<1, dim>> &b,
        const double                               factor = 1)
    {
      for (std::size_t node = 0; node < b.size(); ++node)
        a[node] += factor * b[node];
      return a;
    }
  } // namespace


  template <int dim>
  FluidSide<dim>::FluidSide(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing)
    : models(models)
    , model(*models.fluid)
    , budget(budget)
    , timing(timing)
    , environment(models.environment())
    , viscous_coupling(models)
  {
    if (models.surface)
      cut = std::make_unique<FluidGeometry<dim>>(models);
  }


  template <int dim>
  typename CharacteristicTracer<dim>::Bodies
  FluidSide<dim>::bodies() const
  {
    return cut ? cut->bodies() : typename CharacteristicTracer<dim>::Bodies();
  }


  /// The bodies with their no-slip surfaces, where there is friction.
  template <int dim>
  typename CharacteristicTracer<dim>::Bodies
  FluidSide<dim>::no_slip_bodies()
  {
    auto result = bodies();
    if (cut && models.has_friction())
      {
        const auto phase       = timing.section("cut cells");
        result.walls           = viscous_coupling.walls(*cut);
        result.wall_velocities = cut->surface_velocities();
      }
    return result;
  }


  /// Where the bodies of the surface flux are in this stage, at `time` [s], and how they move. With
  /// contact they get there only as far as they do not run into each other or into walls, with the
  /// velocity that leads there: that at which the stage starts is one that contact may have yet to
  /// stop, or has just stopped. What touches goes on with the velocity that contact has
  /// stopped.
  template <int dim>
  SolidState
  FluidSide<dim>::expected_bodies(const State<dim> &state,
                                  const Stage      &stage,
                                  const double      time) const
  {
    SolidState bodies = state.solid;
    if (stage.ahead() != 0)
      bodies.displacement.add(stage.ahead(), state.solid.velocity);
    const auto &contact = state.contact;
    if (!environment.contact || contact.displacement.size() == 0)
      return bodies;
    if (contact.velocity.size() > 0)
      {
        bodies.displacement = contact.displacement;
        bodies.displacement.add(stage.duration(), contact.velocity);
      }
    const double part = environment.contact->collision_free_fraction(
      {contact.displacement, contact.time}, {bodies.displacement, time});
    if (part < 1)
      bodies.displacement.sadd(part, 1 - part, contact.displacement);
    bodies.velocity = bodies.displacement;
    bodies.velocity.add(-1., contact.displacement);
    bodies.velocity *= 1 / stage.duration();
    return bodies;
  }


  template <int dim>
  void
  FluidSide<dim>::expect(typename FluidGeometry<dim>::Positions places)
  {
    expected = std::move(places);
  }


  template <int dim>
  Misplacement
  FluidSide<dim>::misplacement(const typename FluidGeometry<dim>::Positions &places) const
  {
    const auto  &grid   = model.grid();
    const auto  &cut_at = cut->surface_positions();
    Misplacement result;
    for (unsigned int node = 0; node < places.size(); ++node)
      {
        const auto cell = grid.cell_at(cut_at[node]);
        for (unsigned int d = 0; d < dim; ++d)
          if (const double cells =
                std::abs(places[node][d] - cut_at[node][d]) / grid.cell_width(d, cell[d]);
              cells > result.cells)
            result = {cells, node};
      }
    return result;
  }


  template <int dim>
  void
  FluidSide<dim>::place_surfaces(const State<dim> &state, const Stage &stage)
  {
    if (!cut)
      return;
    const auto   phase  = timing.section("cut cells");
    const double time   = state.clock.time + stage.start() + stage.ahead();
    const auto   bodies = expected_bodies(state, stage, time);
    const auto   given  = std::exchange(expected, {});
    const auto   now    = given.empty() ? models.surface->positions(bodies, time) : given;
    cut->place(state.surface_positions.empty() ? now : state.surface_positions,
               now,
               stage.keeps_rates() ? models.surface->velocities_at(bodies, time, stage.length)
                                   : models.surface->velocities(bodies, time, stage.length));
  }


  /// The fields of a state from a file have a topology object of their own. If no surface has moved
  /// since, it equals the present one, and the fields share that without being remapped: the run
  /// continues to the bit.
  template <int dim>
  void
  FluidSide<dim>::share_parts(FluidState<dim> &state) const
  {
    const auto &parts = bodies().topology;
    if (state.velocity[0].topology() == parts || !cut->is_unmoved())
      return;
    for (auto *velocity : {&state.velocity, &state.acceleration, &state.change})
      for (auto &component : velocity->components)
        component.share(parts);
    state.pressure.share(parts);
    if (is_in_use(state.volume_rates))
      for (auto &half : state.volume_rates.halves)
        for (auto &component : half.components)
          component.share(parts);
    for (auto *fields : {&state.scalars, &state.scalar_rates})
      for (auto &field : *fields)
        field.second.share(parts);
  }


  template <int dim>
  void
  FluidSide<dim>::initialize(State<dim>      &state,
                             Projection<dim> &projection,
                             const double     dt,
                             Report          &report)
  {
    place_surfaces(state, single_stage(dt));
    if (cut && !cut->has_fluid())
      throw InputError(
        "section 'Domain': bodies and obstacles fill the domain: there is no fluid "
        "left in it. Try: a larger domain, smaller ones, or a scene without a fluid.");
    const double time = state.clock.time;
    state.fluid       = model.initial_state(bodies().topology);
    for (const auto &effect : models.effects)
      effect->initialize(model, state.fluid);
    const auto projected = projection.make_divergence_free(
      state.fluid, time, cut ? cut->initial_swept_volume_flux(dt) : SweptVolumeFlux());
    report.linear_iterations += projected.iterations;
    const double at_rest = pressure_at_rest(state.fluid, time);
    for_each_value(state.fluid.pressure,
                   [&](double &value, const auto &, const auto &) { value = at_rest; });
    set_means(state.fluid.pressure, model.grid());
    if (cut)
      {
        report.warn(cut->cut_report().subject, cut->cut_report().message);
        state.surface_positions = models.surface->positions(state.solid, time);
        report.warn("outside", note_of_what_is_outside(models, state.surface_positions));
        viscous_coupling.keep_loads(state, *cut, environment.gravity, time);
      }
    add_columns(report, state, projected.divergence, time);
    count_memory(state.fluid);
  }


  /// What is known of the reduced pressure before one has been solved for: that of a fluid at rest
  /// under the lowest pressure of the openings; where there are none, and a pressure loads
  /// bodies, one with the pressure zero in the middle of the domain. Zero would be a level that
  /// depends on where the origin lies, and which bodies feel.
  template <int dim>
  double
  FluidSide<dim>::pressure_at_rest(const FluidState<dim> &fluid, const double time) const
  {
    double lowest = std::numeric_limits<double>::infinity();
    for (const auto &opening : open_faces(model, fluid.velocity, bodies().topology.get(), time))
      lowest = std::min(lowest, opening.outside);
    lowest = dealii::Utilities::MPI::min(lowest, models.communicator());
    if (std::isfinite(lowest))
      return lowest;
    if (!models.solid)
      return 0;
    const auto middle = (model.grid().lower() + model.grid().upper()) / 2;
    return -model.density() * (environment.gravity * middle);
  }


  /// `act` on every effect, then `book` what each, by its number, has done.
  template <int dim>
  template <class Action, class Book>
  void
  FluidSide<dim>::run_phase(FluidStage<dim> &fluid, const Action &act, const Book &book)
  {
    for (unsigned int e = 0; e < models.effects.size(); ++e)
      {
        fluid.work.reset();
        act(*models.effects[e]);
        book(e);
      }
  }


  template <int dim>
  void
  FluidSide<dim>::count_memory(const FluidState<dim> &state)
  {
    for (const auto &effect : models.effects)
      timing.memory.hold(effect->name, effect->memory_consumption(state));
    if (cut)
      timing.memory.hold("surfaces in the fluid", cut->memory_consumption());
  }


  template <int dim>
  std::unique_ptr<FluidStage<dim>>
  FluidSide<dim>::predict(State<dim> &state, const Stage &stage, Report &report)
  {
    std::optional<Velocity<dim>> begin;
    if (budget.is_on())
      begin = state.fluid.velocity;
    place_surfaces(state, stage);
    if (cut && !cut->has_fluid())
      throw SolveError("bodies and obstacles have filled the domain: there is no fluid left in it. "
                       "Try: a smaller step, or obstacles that leave some.");
    share_parts(state.fluid);
    auto fluid = std::make_unique<FluidStage<dim>>(
      model, state.fluid, environment.gravity, state.clock.time, stage, timing, no_slip_bodies());
    const auto &velocity = state.fluid.velocity;
    if (begin)
      budget.go_on(*begin, velocity);
    const auto book_transport = [&](const unsigned int effect) {
      budget.transport(effect, velocity, fluid->work);
    };
    const auto book = [&](const BudgetTerm term) {
      return [this, &velocity, &fluid, term](const unsigned int effect) {
        budget.accelerate(term, effect, velocity, fluid->work);
      };
    };
    {
      const auto phase = timing.section("transport");
      run_phase(
        *fluid, [&](const auto &effect) { effect.transport(*fluid); }, book_transport);
      fluid->remap();
      budget.transport(velocity);
    }
    auto *const  account = stage.is_last && report.account ? &*report.account : nullptr;
    const double before  = account ? kinetic_energy(model, velocity) : 0;
    {
      const auto phase = timing.section("accelerate");
      run_phase(
        *fluid, [&](const auto &effect) { effect.accelerate(*fluid); }, book(BudgetTerm::forces));
    }
    const double forced = account ? kinetic_energy(model, velocity) : 0;
    {
      const auto phase = timing.section("diffuse");
      if (cut)
        fluid->impedance =
          viscous_coupling.impedance(state, *cut, environment, stage, fluid->viscosity, timing);
      run_phase(
        *fluid, [&](const auto &effect) { effect.diffuse(*fluid); }, book(BudgetTerm::diffusion));
      fluid->impedance.reset();
    }
    if (account)
      {
        account->add_power((forced - before) / fluid->dt);
        account->add_power(WorkOnFluid<dim>(models, cut.get()).friction_of_obstacles(*fluid));
      }
    return fluid;
  }


  template <int dim>
  void
  FluidSide<dim>::finish(FluidStage<dim> &fluid,
                         State<dim>      &state,
                         Report          &report,
                         const double     divergence)
  {
    budget.end_fluid(state.fluid.velocity,
                     fluid.by_contact ? &*fluid.by_contact : nullptr,
                     fluid.advected_from_begin());
    if (fluid.stage.is_last && report.account)
      {
        if (is_carried(models))
          report.account->add_power(-kinetic_energy_outflow(model, state.fluid.velocity));
        for (const auto &effect : models.effects)
          report.account->add_power(effect->power_of_sides(model, state.fluid, fluid.end));
      }
    Vectors pressures; // those that have accelerated the fluid, before friction corrects them
    if (state.impulses)
      {
        const auto phase = timing.section("measure");
        pressures        = pressures_on_surfaces(state, fluid.end);
        if (fluid.stage.keeps_rates()) // as they act in the stage
          pressures = sum(pressures, fluid.forces_by_contact.by_change);
      }
    fluid.finish();
    if (fluid.friction)
      {
        viscous_coupling.keep_loads(state, *cut, environment.gravity, fluid.end);
        viscous_coupling.end(fluid, state, *cut);
      }
    if (cut)
      {
        report.warn(cut->cut_report().subject, cut->cut_report().message);
        state.surface_positions = cut->surface_positions();
        if (state.impulses)
          add_impulses(*state.impulses, fluid, pressures);
      }
    report.linear_iterations += fluid.linear_iterations;
    count_memory(state.fluid);
    if (!fluid.stage.is_last)
      return;
    const auto phase = timing.section("measure");
    add_columns(report, state, divergence, fluid.end);
  }


  template <int dim>
  typename FluidSide<dim>::Vectors
  FluidSide<dim>::loads_on_surfaces(const State<dim> &state, const double time) const
  {
    if (!cut)
      return {};
    return sum(pressures_on_surfaces(state, time), viscous_coupling.forces());
  }


  /// Forces of pressure and weight in the nodes of all surfaces [N].
  template <int dim>
  typename FluidSide<dim>::Vectors
  FluidSide<dim>::pressures_on_surfaces(const State<dim> &state, const double time) const
  {
    return sum(cut->pressure_forces(state.fluid.pressure),
               cut->other_forces(environment.gravity, time));
  }


  /// Of a stage, of `pressures` and friction in the nodes of all surfaces [N].
  template <int dim>
  void
  FluidSide<dim>::add_impulses(Impulses<dim>         &impulses,
                               const FluidStage<dim> &fluid,
                               const Vectors         &pressures) const
  {
    const auto &surface = models.surface->surface();
    const auto  add     = [&](Impulse<dim> &impulse, const Vectors &forces, const Vectors &kept) {
      impulse.add(fluid.stage, sums_over_bodies(surface, forces), sums_over_bodies(surface, kept));
    };
    add(impulses.pressure, pressures, sum(pressures, fluid.forces_by_contact.not_kept, -1));
    if (fluid.friction)
      add(impulses.friction, viscous_coupling.forces(), viscous_coupling.forces());
  }


  template <int dim>
  void
  FluidSide<dim>::add_columns(Report           &report,
                              const State<dim> &state,
                              const double      divergence,
                              const double      time) const
  {
    const auto &fluid = state.fluid;
    append(report.columns, fluid_columns(model, fluid, environment.gravity, divergence));
    for (const auto &effect : models.effects)
      append(report.columns, effect->columns(model, fluid, time));
    if (cut)
      append(report.columns,
             cut->columns(fluid.pressure, environment.gravity, time, viscous_coupling.forces()));
    if (!state.impulses)
      return;
    const auto add = [&](const std::string &name, const Impulse<dim> &impulse) {
      append(report.columns, body_columns(name, "N s", models.surface->surface(), impulse.sum));
    };
    add("pressure impulse", state.impulses->pressure);
    add("viscous impulse", state.impulses->friction);
  }


  template class FluidSide<2>;
  template class FluidSide<3>;
} // namespace undine
