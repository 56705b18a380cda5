// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/relative.h>
#include <undine/coupled/budget/budget.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  template <int dim>
  const char *const Budget<dim>::names[n_terms] = {"transport",
                                                   "forces",
                                                   "diffusion",
                                                   "boundary values",
                                                   "sides",
                                                   "openings",
                                                   "projection",
                                                   "obstacles",
                                                   "interface",
                                                   "fluid at rest",
                                                   "friction",
                                                   "loads",
                                                   "supports",
                                                   "damping",
                                                   "contact",
                                                   "inertia",
                                                   "elasticity",
                                                   "earlier stages",
                                                   "sleep"};


  template <int dim>
  Budget<dim>::Budget(const Models<dim> &models, const BudgetOf kept)
    : models(models)
    , kept(kept)
    , has_contact(models.requests_of_effects().contact_settings.has_value())
    , has_sleep(models.requests_of_effects().sleep_settings.has_value())
    , surface(models.surface.get())
    , by_effect(models.effects.size())
  {
  }


  template <int dim>
  void
  Budget<dim>::follow(const ImmersedSurface<dim> *new_surface)
  {
    surface = new_surface;
  }


  template <int dim>
  void
  Budget<dim>::start()
  {
    gain   = {};
    terms  = {};
    energy = impulse_of_fluid = 0;
    by_effect.assign(models.effects.size(), 0.);
  }


  template <int dim>
  void
  Budget<dim>::go_back_to(const Budget &earlier)
  {
    fluid            = earlier.fluid;
    bodies           = earlier.bodies;
    gain             = earlier.gain;
    terms            = earlier.terms;
    by_effect        = earlier.by_effect;
    energy           = earlier.energy;
    impulse_of_fluid = earlier.impulse_of_fluid;
  }


  template <int dim>
  typename Budget<dim>::Amount
  Budget<dim>::amount(const Velocity<dim> &velocity) const
  {
    return {kinetic_energy(*models.fluid, velocity), linear_momentum(*models.fluid, velocity)};
  }


  template <int dim>
  void
  Budget<dim>::start(const Velocity<dim> &velocity)
  {
    start();
    if (!is_on())
      return;
    fluid = amount(velocity);
    gain.energy -= fluid.energy;
    gain.momentum -= fluid.momentum;
  }


  template <int dim>
  void
  Budget<dim>::start(const SolidAmounts<dim> &amounts)
  {
    bodies = {amounts.energy, amounts.momentum};
  }


  template <int dim>
  void
  Budget<dim>::add(const SolidAmounts<dim> &amounts)
  {
    auto &term = terms[by_stages];
    term       = {amounts.energy - bodies.energy, amounts.momentum - bodies.momentum};
    gain.energy += term.energy;
    gain.momentum += term.momentum;
    energy += std::abs(term.energy);
  }


  template <int dim>
  void
  Budget<dim>::add(const Phase phase, const Velocity<dim> &velocity)
  {
    if (!is_on())
      return;
    const Amount now = amount(velocity);
    terms[phase].energy += now.energy - fluid.energy;
    terms[phase].momentum += now.momentum - fluid.momentum;
    fluid = now;
  }


  template <int dim>
  void
  Budget<dim>::add(const Phase                  phase,
                   const unsigned int           effect,
                   const Velocity<dim>         &velocity,
                   const std::optional<double> &work)
  {
    if (!is_on())
      return;
    const Amount now = amount(velocity);
    const double done =
      work ? dealii::Utilities::MPI::sum(*work, models.communicator()) : now.energy - fluid.energy;
    by_effect[effect] += done;
    terms[phase].energy += done;
    terms[phase].momentum += now.momentum - fluid.momentum;
    fluid = now;
  }


  template <int dim>
  void
  Budget<dim>::add(const PressureBalance<dim> &pressures, const double dt)
  {
    terms[by_boundary_values].energy   = pressures.energy_before - fluid.energy;
    terms[by_boundary_values].momentum = pressures.momentum_before - fluid.momentum;
    terms[by_sides]                    = {dt * pressures.power_of_sides, -dt * pressures.sides};
    terms[by_openings]          = {dt * pressures.power_of_openings, -dt * pressures.openings};
    terms[by_projection].energy = -pressures.loss;
    gain.energy += pressures.energy_after;
    gain.momentum += pressures.momentum_before + pressures.momentum;
    energy += pressures.energy_after;
  }


  template <int dim>
  void
  Budget<dim>::add(const SurfaceExchange<dim> &surfaces, const double dt)
  {
    const auto n_nodes = surfaces.by_fluid.size();
    const auto n_body  = surface->n_body_nodes();
    for (std::size_t node = 0; node < n_nodes; ++node)
      {
        const auto  &force = surfaces.by_fluid[node];
        const double power = surfaces.by_surface_flux[node] * surfaces.velocities[node];
        auto        &term  = terms[surface->moves(node) ? by_interface : by_obstacles];
        term.energy -= dt * power;
        term.momentum -= dt * force;
        impulse_of_fluid += dt * force.norm();
      }
    for (std::size_t node = 0; node < n_body; ++node)
      {
        if (!surface->moves(node))
          continue;
        terms[by_interface].energy += surfaces.on_bodies[node] * surfaces.increment[node];
        terms[by_interface].momentum += dt * surfaces.on_bodies[node];
        terms[by_fluid_at_rest].energy += surfaces.at_rest[node] * surfaces.increment[node];
        terms[by_fluid_at_rest].momentum += dt * surfaces.at_rest[node];
        if (surfaces.friction.empty())
          continue;
        terms[by_friction].energy += surfaces.friction[node] * surfaces.increment[node];
        terms[by_friction].momentum += dt * surfaces.friction[node];
      }
  }


  template <int dim>
  void
  Budget<dim>::add(const SolidBalance<dim> &solid, const double dt)
  {
    gain.energy += solid.kinetic + solid.elastic + solid.contact_energy;
    gain.momentum += solid.momentum;
    energy += std::abs(solid.kinetic) + std::abs(solid.elastic) + std::abs(solid.contact_energy);
    terms[by_loads]             = {solid.loads, dt * solid.loads_force};
    terms[by_supports]          = {solid.supports, dt * solid.supports_force};
    terms[by_damping]           = {-solid.damping, dt * solid.damping_force};
    terms[by_contact]           = {solid.contact + solid.contact_energy, dt * solid.contact_force};
    terms[by_inertia]           = {-solid.inertia_loss, -solid.inertia_gap};
    terms[by_elasticity].energy = -solid.elastic_loss;
    for (unsigned int e = 0; e < models.effects.size(); ++e)
      if (const auto found = solid.loads_by_effect.find(models.effects[e]->name);
          found != solid.loads_by_effect.end())
        by_effect[e] += found->second;
  }


  template <int dim>
  void
  Budget<dim>::add_rest(const SolidAmounts<dim> &rest)
  {
    terms[by_sleep] = {-rest.energy, -rest.momentum};
    gain.energy -= rest.energy;
    gain.momentum -= rest.momentum;
    energy += rest.energy;
  }


  template <int dim>
  bool
  Budget<dim>::concerns(const unsigned int term) const
  {
    if (term < by_obstacles)
      return models.fluid != nullptr;
    if (term == by_obstacles)
      return models.surface &&
             (has_sleep || models.surface->surface().n_nodes() > models.surface->n_body_nodes());
    if (term < by_loads)
      return models.fluid && models.solid && (term != by_friction || models.has_friction());
    return models.solid && (kept == BudgetOf::steps_of_several_stages || term != by_stages) &&
           (has_contact || term != by_contact) && (has_sleep || term != by_sleep);
  }


  template <int dim>
  typename Budget<dim>::Amount
  Budget<dim>::missing() const
  {
    Amount result = gain;
    for (const auto &term : terms)
      {
        result.energy -= term.energy;
        result.momentum -= term.momentum;
      }
    return result;
  }


  /// An effect that has a term of its own, as damping has, needs no other.
  template <int dim>
  void
  Budget<dim>::add_effects(Columns &columns) const
  {
    for (unsigned int e = 0; e < models.effects.size(); ++e)
      {
        const std::string name = "energy by " + models.effects[e]->name;
        if (std::none_of(columns.begin(), columns.end(), [&](const auto &column) {
              return column.name == name;
            }))
          columns.push_back({name, "J", by_effect[e]});
      }
  }


  template <int dim>
  Columns
  Budget<dim>::columns() const
  {
    if (!is_on())
      return {};
    Columns result{{"energy gain", "J", gain.energy}};
    double  energies = std::abs(energy), impulses = impulse_of_fluid;
    for (unsigned int term = 0; term < n_terms; ++term)
      if (concerns(term))
        {
          result.push_back({std::string("energy by ") + names[term], "J", terms[term].energy});
          energies += std::abs(terms[term].energy);
          if (impulse_of_fluid == 0)
            impulses += terms[term].momentum.norm();
        }
    add_effects(result);
    result.push_back({"energy closure", "1", relative(std::abs(missing().energy), energies)});
    for (unsigned int axis = 0; axis < dim; ++axis)
      result.push_back(
        {std::string("momentum gain ") + char('x' + axis), "kg m/s", gain.momentum[axis]});
    for (unsigned int term = 0; term < n_terms; ++term)
      if (concerns(term) && term != by_projection && term != by_elasticity)
        for (unsigned int axis = 0; axis < dim; ++axis)
          result.push_back({std::string("momentum by ") + names[term] + " " + char('x' + axis),
                            "kg m/s",
                            terms[term].momentum[axis]});
    result.push_back({"momentum closure", "1", relative(missing().momentum.norm(), impulses)});
    return result;
  }


  template class Budget<2>;
  template class Budget<3>;
} // namespace undine
