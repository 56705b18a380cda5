// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/step/physics.h>
#include <undine/coupled/step/solid_side.h>
#include <undine/solid/assembly/loads.h>
#include <undine/solid/assembly/sums_by_body.h>
#include <undine/solid/step/solid_columns.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  template <int dim>
  SolidSide<dim>::SolidSide(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing)
    : model(*models.solid)
    , budget(budget)
    , timing(timing)
    , surroundings(models.environment())
    , is_loaded(models.fluid && models.direction != Direction::body_to_fluid)
    , solid_stepper(model)
  {
    if (budget.is_on())
      solid_stepper.keep_balance();
  }


  template <int dim>
  void
  SolidSide<dim>::initialize(State<dim> &state, const double dt, Report &report) const
  {
    state.solid = solid_stepper.initialize(surroundings, state.clock.time, dt);
    expect_loads(state.solid);
    if (surroundings.contact)
      report.warn("contact at the start",
                  surroundings.contact->note_of_start(state.solid.displacement, state.clock.time));
  }


  /// Until it is known how much a fluid loads the bodies, it holds them, as it does those that are
  /// at rest (T4).
  template <int dim>
  void
  SolidSide<dim>::expect_loads(SolidState &solid) const
  {
    solid.impulse_acceleration.clear();
    if (!is_loaded || !model.numerics().integrator->uses_acceleration())
      return;
    solid.impulse_acceleration = solid.acceleration;
    solid.impulse_acceleration *= -1.;
  }


  /// How the bodies that `forces` of contact act on are expected to go on from the begin of the
  /// stage: with the velocity there, without what forces have changed since, of which contact stops
  /// the rest. All others as they would without contact.
  template <int dim>
  typename SolidSide<dim>::Vector
  SolidSide<dim>::expected_velocity(const State<dim> &state,
                                    const Stage      &stage,
                                    const Vector     &forces) const
  {
    auto velocity = state.solid.displacement;
    velocity -= state.stage_begin.displacement;
    velocity.add(stage.length, state.solid.velocity);
    velocity *= 1 / stage.duration();
    auto sizes = forces;
    for (auto &size : sizes)
      size = std::abs(size);
    const auto  of_bodies = sums_by_body(model, sizes);
    const auto &geometry  = model.geometry();
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      if (of_bodies[geometry.body(cell)].norm() > 0)
        for (const auto dof : geometry.dofs(cell))
          if (velocity.in_local_range(dof))
            velocity(dof) = state.stage_begin.velocity(dof);
    velocity.compress(dealii::VectorOperation::insert);
    return velocity;
  }


  /// The bodies of `state` are those from which the stage starts.
  template <int dim>
  void
  SolidSide<dim>::start_contact(State<dim> &state, const Stage &stage) const
  {
    if (!surroundings.contact)
      return;
    auto &contact        = state.contact;
    contact.displacement = state.stage_begin.displacement;
    contact.time         = state.clock.time + stage.begin;
    contact.weight       = stage.contact_weight();
    contact.kept         = stage.kept;
    const auto forces    = surroundings.contact->forces(contact.displacement, contact.time);
    if (forces.size() > 0)
      contact.velocity = expected_velocity(state, stage, forces);
  }


  template <int dim>
  void
  SolidSide<dim>::start(State<dim> &state, const Stage &stage) const
  {
    if (stage.is_first && state.clock.after_fallback &&
        model.numerics().integrator->uses_acceleration())
      {
        state.solid.acceleration =
          solid_stepper.acceleration(state.solid, surroundings, state.clock.time, stage.duration());
        expect_loads(state.solid);
      }
    if (!stage.keeps_rates())
      return;
    state.stage_begin = state.solid;
    if (stage.is_first)
      state.mean_velocity = state.solid.velocity;
    if (stage.going_on() != 0)
      {
        state.solid.displacement.add(stage.going_on(), state.mean_velocity);
        state.solid.velocity.add(stage.going_on(), state.stage_begin.acceleration);
      }
    start_contact(state, stage);
    if (!budget.is_on())
      return;
    Vector jump = state.solid.velocity, momenta = model.vector();
    jump.add(-1., state.stage_begin.velocity);
    solid_stepper.mass().vmult(momenta, jump);
    budget.go_on(solid_stepper.amounts(state.stage_begin),
                 solid_stepper.amounts(state.solid),
                 {(jump * momenta) / 2, state.stage_begin.velocity * momenta});
  }


  template <int dim>
  SolidReport<dim>
  SolidSide<dim>::advance(State<dim> &state, const Stage &stage, const Vector &forces)
  {
    return solid_stepper.step(state.solid,
                              surroundings,
                              state.clock.time + stage.start(),
                              stage.length,
                              timing,
                              forces,
                              state.contact,
                              begin_of(state, stage));
  }


  /// (u - u^b).M a^b, with which the stage has gone on [W].
  template <int dim>
  double
  SolidSide<dim>::work_of_kept_rate(const State<dim> &state) const
  {
    Vector change = state.solid.velocity, force = model.vector();
    change.add(-1., state.stage_begin.velocity);
    solid_stepper.mass().vmult(force, state.stage_begin.acceleration);
    return change * force;
  }


  template <int dim>
  void
  SolidSide<dim>::end(State<dim> &state, const Stage &stage) const
  {
    if (!stage.keeps_rates())
      return;
    if (budget.is_on())
      budget.end_bodies(stage.going_on() * work_of_kept_rate(state));
    if (stage.kept == KeptRate::mean)
      {
        const double of_begin = stage.going_on() / stage.duration();
        const double of_end   = stage.length / stage.duration();
        state.mean_velocity.sadd(of_begin, of_end, state.solid.velocity);
        state.solid.acceleration.sadd(of_end, of_begin, state.stage_begin.acceleration);
      }
    state.stage_begin = {};
    state.contact.displacement.clear();
    state.contact.velocity.clear();
    if (!stage.is_last)
      return;
    state.mean_velocity.clear();
    state.contact = {};
  }


  /// Of loads, by the mean of those at both ends of the step, supports and obstacles that bodies
  /// touch.
  template <int dim>
  void
  SolidSide<dim>::add_work(EnergyAccount          &account,
                           const State<dim>       &state,
                           const Stage            &stage,
                           const SolidReport<dim> &solid) const
  {
    const double begin = state.clock.time, time = begin + stage.end;
    auto         way = state.solid.displacement;
    way -= state.step_begin.displacement;
    const auto add = [&](const auto &before, const auto &now) {
      account.add_work((before * way + now * way) / 2, now * way);
    };
    add(dead_loads(model, surroundings, begin), dead_loads(model, surroundings, time));
    if (has_pressure_loads(model))
      add(pressure_loads(model, state.step_begin.displacement, begin),
          pressure_loads(model, state.solid.displacement, time));
    if (solid.reactions.size() > 0 && model.numerics().integrator->has_inertia())
      account.add_power(solid.reactions * state.solid.velocity);
    else if (solid.reactions.size() > 0) // supports may jump: there is no power
      {
        auto before = solid.reactions;
        if (!is_loaded && !surroundings.contact) // else what they were at the begin is not known
          {
            auto still            = state.step_begin;
            still.velocity        = 0;
            const auto unbalanced = solid_stepper.unbalanced_forces(still, surroundings, begin);
            for (const auto &fixed : model.fixed())
              before(fixed.dof) = -unbalanced(fixed.dof);
            before.compress(dealii::VectorOperation::insert);
          }
        add(before, solid.reactions);
      }
    if (!surroundings.contact)
      return;
    // What the potential gains as obstacles move and bodies do not, at the end: over all of the
    // stage it gains much less, since it bends upwards as gaps close.
    const auto  &displacement = state.solid.displacement;
    const double before       = 1e-3 * stage.length;
    account.add_power((surroundings.contact->energy(displacement, time) -
                       surroundings.contact->energy(displacement, time - before)) /
                      before);
  }


  template <int dim>
  void
  SolidSide<dim>::finish(const State<dim>       &state,
                         const Stage            &stage,
                         const SolidReport<dim> &solid,
                         Report                 &report) const
  {
    report.newton_iterations += solid.newton.iterations;
    report.linear_iterations += solid.newton.linear_iterations;
    report.newton_reduction = reduction(solid.newton);
    if (solid.newton.scale > 0)
      report.newton_residual =
        std::max(report.newton_residual, solid.newton.residuals.back() / solid.newton.scale);
    report.warn("linear solver", solid.note);
    if (!stage.is_last)
      return;
    add_columns(report, state, state.clock.time + stage.end, solid);
    if (report.account)
      {
        const auto measured = timing.section("measure");
        add_work(*report.account, state, stage, solid);
      }
  }


  template <int dim>
  void
  SolidSide<dim>::add_columns(Report                 &report,
                              const State<dim>       &state,
                              const double            time,
                              const SolidReport<dim> &solid) const
  {
    const auto measured = timing.section("measure");
    append(report.columns,
           solid_columns(model, solid_stepper, surroundings, state.solid, time, solid));
  }


  template <int dim>
  void
  SolidSide<dim>::add_columns(Report &report, const State<dim> &state, const double time) const
  {
    const SolidReport<dim> no_step;
    add_columns(report, state, time, no_step);
  }


  template class SolidSide<2>;
  template class SolidSide<3>;
} // namespace undine
