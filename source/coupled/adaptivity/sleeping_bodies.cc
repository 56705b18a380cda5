// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/interruption.h>
#include <undine/coupled/adaptivity/sleeping_bodies.h>
#include <undine/solid/assembly/mass_matrix.h>
#include <undine/solid/assembly/sums_by_body.h>
#include <undine/solid/solvers/mass_solve.h>
#include <undine/solid/step/solid_columns.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// Are all supports and loads of a body, other than fluid and contact, constant in time?
    template <int dim>
    std::vector<bool>
    find_steady(const SolidModel<dim> &model, const SolidEnvironment<dim> &environment)
    {
      std::vector<bool> result;
      for (const auto &body : model.bodies())
        {
          bool changes = body.load.names_time();
          for (const auto &boundary : body.boundaries)
            changes |= boundary.motion.names_time() || boundary.traction.names_time() ||
                       boundary.pressure.names_time();
          for (const auto &force : environment.forces)
            changes |= force.body == body.name &&
                       (force.acceleration.names_time() || force.per_volume.names_time());
          result.push_back(!changes);
        }
      return result;
    }


    /// nullptr if nothing acts on the surface of bodies.
    template <int dim>
    std::unique_ptr<const BodySurface<dim>>
    surface_of(const Models<dim> &models)
    {
      if (models.surface)
        return std::make_unique<const BodySurface<dim>>(*models.surface->bodies());
      if (models.requests_of_effects().contact_settings)
        return std::make_unique<const BodySurface<dim>>(*models.solid);
      return nullptr;
    }


    /// For each node; empty without a surface.
    template <int dim>
    std::vector<unsigned int>
    bodies_of_nodes(const BodySurface<dim> *bodies)
    {
      if (!bodies)
        return {};
      const auto               &facets = bodies->surface().facets();
      std::vector<unsigned int> result(bodies->n_nodes());
      for (unsigned int facet = 0; facet < facets.size(); ++facet)
        for (const unsigned int node : facets[facet])
          result[node] = bodies->surface().body(facet);
      return result;
    }


    /// A step may end a rounding error too early.
    constexpr double almost = 1 - 1e-9;
  } // namespace


  template <int dim>
  SleepingBodies<dim>::SleepingBodies(const Models<dim> &models,
                                      Budget<dim>       &budget,
                                      TimingTree        &timing,
                                      Make               make,
                                      StartAnew          start_anew)
    : Physics<dim>(models.communicator())
    , all(models)
    , budget(budget)
    , timing(timing)
    , make(std::move(make))
    , start_anew(std::move(start_anew))
    , environment(models.requests_of_effects())
    , settings(*environment.sleep_settings)
    , contact(models.contact_of_bodies())
    , surface(surface_of(models))
    , body_of_node(bodies_of_nodes(surface.get()))
    , may_sleep(find_steady(*models.solid, environment))
    , sleepers(models.solid->bodies().size(), false)
    , physics(this->make(models))
  {
    for (const auto &body : measure_bodies(*models.solid, models.solid->vector()))
      masses.push_back(body.mass);
  }


  template <int dim>
  void
  SleepingBodies<dim>::initialize(State<dim> &state, const double dt, Report &report)
  {
    physics->initialize(state, dt, report);
    for (const auto &column : report.columns)
      names.emplace_back(column.name, column.unit);
    state.sleep = {};
    choose(state);
    add_columns(report, state);
  }


  template <int dim>
  void
  SleepingBodies<dim>::advance(State<dim> &state, const Stages &stages, Report &report)
  {
    const auto saved = state;
    const auto empty = report;
    auto       sleep = saved.sleep;
    for (bool is_first = true;; is_first = false)
      {
        state.sleep = sleep;
        try
          {
            Physics<dim>::advance(
              state,
              is_first || !contact || stages.size() == 1 ? stages : start_anew(stages.back().end),
              report);
            if (!sleep.wake_with(state.sleep))
              return;
          }
        catch (const Interruption &)
          {
            throw;
          }
        catch (const Error &)
          {
            if (!sleep.any_asleep())
              throw;
            sleep.wake_all();
          }
        state  = saved;
        report = empty;
        budget.start(state.budget_rates);
      }
  }


  template <int dim>
  void
  SleepingBodies<dim>::solve_stage(State<dim> &state, const Stage &stage, Report &report)
  {
    if (stage.is_first)
      {
        const auto timed = timing.section("sleep");
        choose(state);
        take_rest(state);
        if (part && part->of_awake)
          {
            whole       = state.solid;
            state.solid = part->of_awake->taken_from(whole);
            if (state.step_begin.displacement.size() > 0)
              state.step_begin = part->of_awake->taken_from(state.step_begin);
          }
      }
    if (physics)
      physics->solve_stage(state, stage, report);
    if (!stage.is_last)
      return;
    const auto   timed = timing.section("sleep");
    const double time  = state.clock.time + stage.end;
    complete(report, state, time);
    change_sleep(state, stage.end, time);
    if (part && part->of_awake)
      {
        part->of_awake->put_into(whole, state.solid);
        state.solid = whole;
      }
    add_columns(report, state);
  }


  /// The equations become those of the bodies that are awake.
  template <int dim>
  void
  SleepingBodies<dim>::choose(State<dim> &state)
  {
    auto &sleep = state.sleep;
    if (!sleep.in_use())
      {
        sleep.asleep.assign(masses.size(), false);
        sleep.slow_time.assign(masses.size(), 0.);
        sleep.unbalanced.assign(masses.size(), sleep.unknown);
        sleep.loads.assign(surface ? surface->n_nodes() : 0, {});
      }
    // A scene may have been changed before it was resumed.
    for (unsigned int body = 0; body < may_sleep.size(); ++body)
      if (sleep.asleep[body] && !may_sleep[body])
        sleep.wake(body);
    compare_loads(state);
    if (sleepers == sleep.asleep)
      return;
    sleepers = sleep.asleep;
    physics.reset();
    part.reset();
    if (sleep.any_asleep())
      make_reduced_models(state);
    const auto &models = part ? part->models : all;
    budget.follow(models.surface.get());
    if (models.solid || models.fluid)
      physics = make(models);
  }


  /// What is out of balance is noted of those that have just fallen asleep. Those that sleep
  /// without having fallen asleep here wake where it has changed: a run is resumed, with other
  /// loads, gravity or materials perhaps.
  template <int dim>
  void
  SleepingBodies<dim>::compare_loads(State<dim> &state) const
  {
    auto                     &sleep = state.sleep;
    std::vector<unsigned int> asked;
    for (unsigned int body = 0; body < masses.size(); ++body)
      if (sleep.asleep[body] &&
          (sleep.unbalanced[body] == sleep.unknown || sleepers.empty() || !sleepers[body]))
        asked.push_back(body);
    if (asked.empty())
      return;
    const auto now = unbalanced(state, sleep.asleep);
    for (const unsigned int body : asked)
      if (sleep.unbalanced[body] == sleep.unknown)
        sleep.unbalanced[body] = now[body];
      else if (std::abs(now[body] - sleep.unbalanced[body]) >
               masses[body] * settings.speed / settings.time)
        sleep.wake(body);
  }


  /// SleepState::unbalanced of the bodies that sleep.
  template <int dim>
  std::vector<double>
  SleepingBodies<dim>::unbalanced(const State<dim> &state, const std::vector<bool> &asleep) const
  {
    const SolidModel<dim>   model(*all.solid, asleep);
    const PartOfBodies<dim> part_of_all(*all.solid, model);
    auto                    still = part_of_all.taken_from(state.solid);
    still.velocity                = 0;
    auto forces = SolidStepper<dim>(model).unbalanced_forces(still, environment, state.clock.time);
    for (auto &force : forces)
      force = std::abs(force);
    const auto          sums = sums_by_body(model, forces);
    std::vector<double> result(masses.size(), 0.);
    for (unsigned int body = 0; body < masses.size(); ++body)
      for (unsigned int axis = 0; axis < dim; ++axis)
        result[body] += sums[body][axis];
    return result;
  }


  template <int dim>
  void
  SleepingBodies<dim>::make_reduced_models(const State<dim> &state)
  {
    part            = std::make_unique<ReducedModels>();
    part->asleep    = std::make_unique<const SolidModel<dim>>(*all.solid, sleepers);
    part->of_asleep = std::make_unique<const PartOfBodies<dim>>(*all.solid, *part->asleep);

    auto awake = sleepers;
    awake.flip();
    auto &models        = part->models;
    models.fluid        = all.fluid;
    models.effects      = all.effects;
    models.direction    = all.direction;
    models.void_regions = all.void_regions;
    if (std::find(awake.begin(), awake.end(), true) != awake.end())
      {
        models.solid   = std::make_shared<const SolidModel<dim>>(*all.solid, awake);
        part->of_awake = std::make_unique<const PartOfBodies<dim>>(*all.solid, *models.solid);
      }
    keep_still(state);
  }


  /// For fluid and contact the surfaces of sleeping bodies become surfaces that do not move.
  template <int dim>
  void
  SleepingBodies<dim>::keep_still(const State<dim> &state)
  {
    auto      &models  = part->models;
    const auto stopped = [&](const auto &displacement) {
      return part->of_awake ? BodySurface<dim>(*surface, *part->of_awake, displacement)
                            : BodySurface<dim>(*surface, displacement);
    };
    if (all.surface)
      models.surface = std::make_shared<const ImmersedSurface<dim>>(
        *all.surface,
        stopped(all.direction == Direction::fluid_to_body ? start_of_bodies(*all.solid).displacement
                                                          : state.solid.displacement));
    models.for_awake         = environment;
    models.for_awake->asleep = measure_asleep(state);
    if (contact)
      models.for_awake->contact = make_contact<dim>(
        *contact, models.solid ? *models.solid : *all.solid, stopped(state.solid.displacement));
  }


  template <int dim>
  std::shared_ptr<const SolidMeasures<dim>>
  SleepingBodies<dim>::measure_asleep(const State<dim> &state) const
  {
    const auto             &model = *part->asleep;
    const SolidStepper<dim> step(model);
    const double            time  = state.clock.time;
    auto                    still = part->of_asleep->taken_from(state.solid);
    still.velocity                = 0;
    still.acceleration            = 0;
    SolidReport<dim> report;
    report.reactions = model.vector();
    auto forces      = step.unbalanced_forces(still, environment, time);
    if (surface)
      BodySurface<dim>(*surface, *part->of_asleep, state.solid.displacement)
        .add(forces, state.sleep.loads);
    for (const auto &fixed : model.fixed())
      report.reactions(fixed.dof) = -forces(fixed.dof);
    report.reactions.compress(dealii::VectorOperation::insert);
    return std::make_shared<const SolidMeasures<dim>>(
      measure_solid(model, step, environment, still, time, report));
  }


  /// Bodies that have just fallen asleep stop.
  template <int dim>
  void
  SleepingBodies<dim>::take_rest(State<dim> &state)
  {
    if (!part || state.sleep.settled)
      return;
    const auto &model = *part->asleep;
    if (budget.is_on())
      {
        const auto velocity     = part->of_asleep->taken_from(state.solid.velocity);
        const auto acceleration = part->of_asleep->taken_from(state.solid.acceleration);
        const auto mass         = mass_matrix(model);
        auto       forces       = model.vector();
        mass.vmult(forces, acceleration);
        SolidAmounts<dim> rest, rates;
        rest.kinetic   = kinetic_energy(model, mass, velocity);
        rest.momentum  = linear_momentum(model, velocity);
        rates.kinetic  = velocity * forces;
        rates.momentum = linear_momentum(model, acceleration);
        budget.add_rest(rest, rates);
      }
    part->of_asleep->put_into(state.solid.velocity, model.vector());
    auto acceleration = model.vector();
    if (state.solid.impulse_acceleration.size() > 0 &&
        model.numerics().integrator->uses_acceleration())
      {
        // What loads and stresses would bring, fluid and contact take back (T4).
        auto still     = part->of_asleep->taken_from(state.solid);
        still.velocity = 0;
        acceleration   = solve_mass(
          model,
          mass_matrix(model),
          SolidStepper<dim>(model).unbalanced_forces(still, environment, state.clock.time),
          model.vector());
        auto impulses = acceleration;
        impulses *= -1.;
        part->of_asleep->put_into(state.solid.impulse_acceleration, impulses);
      }
    part->of_asleep->put_into(state.solid.acceleration, acceleration);
    state.sleep.settled = true;
  }


  /// Of fluid and contact, in the nodes of the surfaces of all bodies [N].
  template <int dim>
  typename SleepingBodies<dim>::Vectors
  SleepingBodies<dim>::loads_on_bodies(const State<dim> &state, const double time) const
  {
    Vectors result(state.sleep.loads.size());
    if (result.empty())
      return result;
    const auto add = [&](const Vectors &more) {
      for (std::size_t node = 0; node < std::min(result.size(), more.size()); ++node)
        result[node] += more[node];
    };
    if (physics)
      add(physics->loads_on_surfaces(state, time));
    if (contact)
      {
        const auto of_awake = part ? part->models.for_awake->contact : contact;
        add(of_awake->nodal_forces(state.solid.displacement, time));
      }
    return result;
  }


  /// Of bodies that are awake; true if one has been slow for long enough.
  template <int dim>
  bool
  SleepingBodies<dim>::count_quiet_time(State<dim> &state, const double dt) const
  {
    auto       &sleep = state.sleep;
    const auto &awake = part ? part->models.solid : all.solid;
    if (!awake)
      return false;
    bool       any    = false;
    const auto speeds = maximum_speeds(*awake, state.solid.velocity);
    for (unsigned int body = 0; body < speeds.size(); ++body)
      if (!sleep.asleep[body])
        {
          const bool is_slow    = may_sleep[body] && speeds[body] <= settings.speed;
          sleep.slow_time[body] = is_slow ? sleep.slow_time[body] + dt : 0;
          any |= sleep.slow_time[body] >= almost * settings.time;
        }
    return any;
  }


  template <int dim>
  bool
  SleepingBodies<dim>::has_fallen_asleep_in_contact(const State<dim>        &state,
                                                    const std::vector<bool> &was_asleep,
                                                    const double             time) const
  {
    if (!contact || was_asleep == state.sleep.asleep)
      return false;
    const auto of_awake = part ? part->models.for_awake->contact : contact;
    const auto forces   = of_awake->nodal_forces(state.solid.displacement, time);
    for (std::size_t node = 0; node < std::min(forces.size(), body_of_node.size()); ++node)
      if (const auto body = body_of_node[node];
          forces[node].norm() > 0 && state.sleep.asleep[body] && !was_asleep[body])
        return true;
    return false;
  }


  /// `state` holds the bodies that are awake.
  template <int dim>
  void
  SleepingBodies<dim>::change_sleep(State<dim> &state, const double dt, const double time) const
  {
    auto &sleep       = state.sleep;
    sleep.begins_anew = false;
    if (!count_quiet_time(state, dt) && !sleep.any_asleep())
      return;
    const auto          loads = loads_on_bodies(state, time);
    std::vector<double> changes(masses.size());
    for (unsigned int node = 0; node < loads.size(); ++node)
      changes[body_of_node[node]] += (loads[node] - sleep.loads[node]).norm();
    const auto was_asleep = sleep.asleep;
    for (unsigned int body = 0; body < masses.size(); ++body)
      if (!was_asleep[body] && sleep.slow_time[body] >= almost * settings.time)
        {
          sleep.asleep[body] = true;
          sleep.settled      = false;
        }
      else if (was_asleep[body] && changes[body] > masses[body] * settings.speed / settings.time)
        sleep.wake(body);
    sleep.begins_anew = has_fallen_asleep_in_contact(state, was_asleep, time);
    for (unsigned int node = 0; node < loads.size(); ++node)
      if (!was_asleep[body_of_node[node]])
        sleep.loads[node] = loads[node];
  }


  /// Where no body is awake: the columns that are missing, with zeros for what is not done.
  template <int dim>
  void
  SleepingBodies<dim>::complete(Report &report, const State<dim> &state, const double time) const
  {
    if (!part || part->of_awake)
      return;
    const auto &of_awake = *part->models.for_awake;
    append(report.columns, columns_of(*of_awake.asleep, all.solid->bodies()));
    if (of_awake.contact)
      append(report.columns, of_awake.contact->columns(state.solid.displacement, time));
    Columns ordered;
    for (const auto &known : names)
      {
        const auto found = std::find_if(report.columns.begin(),
                                        report.columns.end(),
                                        [&](const auto &c) { return c.name == known.first; });
        ordered.push_back(found == report.columns.end() ? Column{known.first, known.second, 0.}
                                                        : *found);
      }
    report.columns = ordered;
  }


  template <int dim>
  void
  SleepingBodies<dim>::add_columns(Report &report, const State<dim> &state) const
  {
    const auto &bodies = all.solid->bodies();
    for (unsigned int body = 0; body < bodies.size(); ++body)
      report.columns.push_back(
        {"asleep " + bodies[body].name, "1", state.sleep.asleep[body] ? 1. : 0.});
  }


  template class SleepingBodies<2>;
  template class SleepingBodies<3>;
} // namespace undine
