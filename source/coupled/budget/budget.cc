// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/relative.h>
#include <undine/coupled/budget/budget.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace undine
{
  namespace
  {
    constexpr double tiny = std::numeric_limits<double>::min();

    /// All terms in the order of their columns.
    std::vector<BudgetTerm>
    all_terms()
    {
      std::vector<BudgetTerm> result;
      for (int term = 0; term < int(BudgetTerm::number); ++term)
        result.push_back(BudgetTerm(term));
      return result;
    }


    /// a - b.
    template <int dim>
    Velocity<dim>
    difference(Velocity<dim> a, const Velocity<dim> &b)
    {
      add(a, -1., b);
      return a;
    }
  } // namespace


  template <int dim>
  const char *
  Budget<dim>::name(const BudgetTerm term)
  {
    switch (term)
      {
        case BudgetTerm::transport:
          return "transport";
        case BudgetTerm::forces:
          return "forces";
        case BudgetTerm::diffusion:
          return "diffusion";
        case BudgetTerm::boundary_values:
          return "boundary values";
        case BudgetTerm::sides:
          return "sides";
        case BudgetTerm::openings:
          return "openings";
        case BudgetTerm::obstacles:
          return "obstacles";
        case BudgetTerm::interface:
          return "interface";
        case BudgetTerm::fluid_at_rest:
          return "fluid at rest";
        case BudgetTerm::friction:
          return "friction";
        case BudgetTerm::loads:
          return "loads";
        case BudgetTerm::supports:
          return "supports";
        case BudgetTerm::damping:
          return "damping";
        case BudgetTerm::contact:
          return "contact";
        case BudgetTerm::integrator:
          return "integrator";
        case BudgetTerm::sleep:
          return "sleep";
        case BudgetTerm::number:
          break;
      }
    return "";
  }


  template <int dim>
  Budget<dim>::Budget(const Models<dim> &models, const KeepBudget kept)
    : models(models)
    , kept(kept)
    , has_contact(models.requests_of_effects().contact_settings.has_value())
    , has_sleep(models.requests_of_effects().sleep_settings.has_value())
    , surface(models.surface.get())
  {
    start({});
  }


  template <int dim>
  void
  Budget<dim>::follow(const ImmersedSurface<dim> *new_surface)
  {
    surface = new_surface;
  }


  template <int dim>
  void
  Budget<dim>::start(const BudgetAmounts<dim> &rates)
  {
    books                   = {};
    books.amounts.by_effect = std::vector<double>(models.effects.size());
    books.rates.push_back(rates.known ? rates : books.amounts);
    books.knows_rates = rates.known;
  }


  template <int dim>
  void
  Budget<dim>::go_back_to(const Budget &earlier)
  {
    books = earlier.books;
  }


  template <int dim>
  void
  Budget<dim>::add_rest(const SolidAmounts<dim> &rest, const SolidAmounts<dim> &rates)
  {
    if (!is_on())
      return;
    books.amounts[BudgetTerm::sleep].add(-1., {rest.kinetic, rest.momentum});
    books.gain.add(-1., {rest.kinetic, rest.momentum});
    books.energy += rest.kinetic;
    if (books.knows_rates)
      books.rates.front()[BudgetTerm::sleep].add(-1., {rates.kinetic, rates.momentum});
  }


  template <int dim>
  void
  Budget<dim>::begin_stage(const Stage &stage)
  {
    if (!is_on())
      return;
    books.stage            = stage;
    books.acting           = {};
    books.acting.by_effect = std::vector<double>(models.effects.size());
    for (std::size_t j = 0; j < stage.earlier.size(); ++j)
      books.amounts.add(stage.earlier[j].length, books.rates[j]);
  }


  template <int dim>
  void
  Budget<dim>::end_stage()
  {
    if (!is_on())
      return;
    books.amounts.add(1., books.acting);
    Amounts rates;
    rates.by_effect = std::vector<double>(models.effects.size());
    rates.known     = true;
    rates.add(1 / books.stage.length, books.acting);
    books.rates.push_back(rates);
    if (books.stage.kept != KeptRate::mean)
      books.fluid = books.bodies = {};
    books.knows_rates = true;
  }


  template <int dim>
  BudgetAmounts<dim>
  Budget<dim>::rates() const
  {
    return is_on() && books.stage.keeps_rates() ? books.rates.back() : Amounts();
  }


  template <int dim>
  BudgetAmounts<dim>
  Budget<dim>::rates_at_start() const
  {
    Amounts result;
    result.by_effect = std::vector<double>(models.effects.size());
    result.known     = is_on();
    return result;
  }


  template <int dim>
  typename Budget<dim>::Amount
  Budget<dim>::amount(const Velocity<dim> &velocity) const
  {
    return {kinetic_energy(*models.fluid, velocity), linear_momentum(*models.fluid, velocity)};
  }


  /// For how long the stage goes on with the rate that was kept [s].
  template <int dim>
  double
  Budget<dim>::duration_of_kept() const
  {
    return books.stage.keeps_rates() ? books.stage.going_on() : 0.;
  }


  template <int dim>
  void
  Budget<dim>::go_on(const Velocity<dim> &begin, const Velocity<dim> &start)
  {
    if (!is_on())
      return;
    const auto   change = difference(start, begin);
    const double jump   = kinetic_energy(*models.fluid, change);
    books.at_begin      = amount(begin);
    books.at_start      = amount(start);
    books.begin_along   = inner_product(*models.fluid, begin, change);
    books.last_energy   = books.at_start.energy;
    books.gain.add(-1., books.at_begin);
    const double w = duration_of_kept();
    if (!books.knows_rates)
      {
        books.fluid.by_integrator = books.begin_along / std::max(w, tiny);
        books.fluid.momentum      = linear_momentum(*models.fluid, change) / std::max(w, tiny);
      }
    books.amounts[BudgetTerm::integrator].energy += jump + w * books.fluid.by_integrator;
    books.amounts[BudgetTerm::transport].add(w, {books.fluid.by_transport, books.fluid.momentum});
    if (books.advecting >= 0)
      books.amounts.by_effect[books.advecting] += w * books.fluid.by_transport;
  }


  template <int dim>
  void
  Budget<dim>::go_on(const SolidAmounts<dim> &begin,
                     const SolidAmounts<dim> &start,
                     const Jump              &jump)
  {
    if (!is_on())
      return;
    const Amount change{start.energy() - begin.energy(), start.momentum - begin.momentum};
    const double w = duration_of_kept();
    books.gain.add(1., change);
    books.energy += std::abs(change.energy);
    if (!books.knows_rates)
      {
        books.bodies.by_integrator = jump.along / std::max(w, tiny);
        books.bodies.momentum      = change.momentum / std::max(w, tiny);
      }
    // The work of internal forces is among the rates.
    books.amounts[BudgetTerm::integrator].add(
      1.,
      {jump.half_square + w * books.bodies.by_integrator + start.elastic - begin.elastic,
       w * books.bodies.momentum});
  }


  template <int dim>
  void
  Budget<dim>::end_bodies(const double along)
  {
    const double w     = duration_of_kept();
    auto        &kept  = books.bodies;
    kept.by_integrator = (w * kept.by_integrator + along) / books.stage.duration();
    kept.momentum *= w / books.stage.duration();
  }


  template <int dim>
  void
  Budget<dim>::transport(const Velocity<dim> &velocity)
  {
    if (!is_on())
      return;
    auto        &term = books.amounts[BudgetTerm::transport];
    const Amount now  = amount(velocity);
    term.add(1., {now.energy - books.last_energy, now.momentum - books.at_start.momentum});
    books.last_energy = now.energy;
    books.advected = books.last = velocity;
  }


  template <int dim>
  void
  Budget<dim>::transport(const unsigned int           effect,
                         const Velocity<dim>         &velocity,
                         const std::optional<double> &work)
  {
    if (!is_on())
      return;
    const double energy = kinetic_energy(*models.fluid, velocity);
    const double done =
      work ? dealii::Utilities::MPI::sum(*work, models.communicator()) : energy - books.last_energy;
    if (energy != books.last_energy)
      books.advecting = effect;
    books.amounts.by_effect[effect] += done;
    books.amounts[BudgetTerm::transport].energy += done;
    books.last_energy = energy;
  }


  template <int dim>
  void
  Budget<dim>::accelerate(const BudgetTerm             term,
                          const unsigned int           effect,
                          const Velocity<dim>         &velocity,
                          const std::optional<double> &work)
  {
    if (!is_on())
      return;
    auto         change = difference(velocity, books.last);
    const double along  = inner_product(*models.fluid, books.last, change);
    const double square = kinetic_energy(*models.fluid, change);
    if (!work && square == 0)
      return;
    const double own =
      work ? dealii::Utilities::MPI::sum(*work, models.communicator()) - along - square : 0.;
    books.changes.push_back({term, int(effect), std::move(change), own});
    books.last = velocity;
  }


  template <int dim>
  void
  Budget<dim>::add(const PressureBalance<dim> &pressures,
                   const Velocity<dim>        &before,
                   const Velocity<dim>        &after)
  {
    const double dt = books.stage.length;
    books.changes.push_back({BudgetTerm::boundary_values, -1, difference(before, books.last), 0.});
    for (const auto &change : books.changes)
      {
        const double energy =
          inner_product(*models.fluid, after, change.velocity) + change.own_work;
        books.acting[change.term].add(1.,
                                      {energy, linear_momentum(*models.fluid, change.velocity)});
        if (change.effect >= 0)
          books.acting.by_effect[change.effect] += energy;
      }
    books.changes.clear();
    books.acting[BudgetTerm::sides].add(dt, {pressures.power_of_sides, -pressures.sides});
    books.acting[BudgetTerm::openings].add(dt, {pressures.power_of_openings, -pressures.openings});
    const double square = kinetic_energy(*models.fluid, difference(after, books.advected));
    books.amounts[BudgetTerm::integrator].energy -= square;
    books.impulse_of_fluid += std::sqrt(2 * mass_of_fluid() * square);
  }


  /// That of the whole domain [kg].
  template <int dim>
  double
  Budget<dim>::mass_of_fluid() const
  {
    const auto &grid = models.fluid->grid();
    double      mass = models.fluid->density();
    for (unsigned int axis = 0; axis < dim; ++axis)
      mass *= grid.upper()[axis] - grid.lower()[axis];
    return mass;
  }


  template <int dim>
  void
  Budget<dim>::end_fluid(const Velocity<dim> &velocity,
                         const Velocity<dim> *by_contact,
                         const Velocity<dim> *begin)
  {
    if (!is_on())
      return;
    const auto  &fluid = *models.fluid;
    const Amount now   = amount(velocity);
    books.gain.add(1., now);
    // Velocities by which the domain's size is known to rounding after the stage.
    const double rounding = std::numeric_limits<double>::epsilon() *
                            (fluid.grid().upper() - fluid.grid().lower()).norm() /
                            books.stage.length;
    books.impulse_rounding += mass_of_fluid() * rounding;
    books.energy_rounding += mass_of_fluid() * rounding * rounding;
    books.energy = std::max(books.energy, now.energy);
    if (by_contact)
      {
        const Amount handed_on{inner_product(fluid, velocity, *by_contact),
                               linear_momentum(fluid, *by_contact)};
        books.acting[BudgetTerm::contact].add(-1., handed_on);
        books.amounts[BudgetTerm::contact].add(1., handed_on);
      }
    auto &kept_rate = books.fluid;
    if (begin)
      {
        const double w        = duration_of_kept();
        const double duration = books.stage.duration();
        const auto   change   = difference(books.advected, *begin);
        const double along    = inner_product(fluid, *begin, change);
        kept_rate.by_integrator =
          (w * kept_rate.by_integrator + inner_product(fluid, velocity, change) - along) / duration;
        kept_rate.by_transport =
          (w * kept_rate.by_transport + along - books.begin_along) / duration;
        kept_rate.momentum = (w * kept_rate.momentum + linear_momentum(fluid, change) -
                              (books.at_start.momentum - books.at_begin.momentum)) /
                             duration;
      }
    else
      kept_rate = {};
  }


  template <int dim>
  void
  Budget<dim>::add(const SurfaceExchange<dim> &surfaces)
  {
    const double dt      = books.stage.length;
    const auto   n_nodes = surfaces.by_fluid.size();
    const auto   n_body  = surface->n_body_nodes();
    auto        &acting  = books.acting;
    for (std::size_t node = 0; node < n_nodes; ++node)
      {
        const auto  &force = surfaces.by_fluid[node];
        const double power = surfaces.by_surface_flux[node] * surfaces.velocities[node];
        acting[surface->moves(node) ? BudgetTerm::interface : BudgetTerm::obstacles].add(
          -dt, {power, force});
        books.impulse_of_fluid += dt * force.norm();
      }
    acting[BudgetTerm::interface].energy -= dt * surfaces.power_beside_velocities;
    for (std::size_t node = 0; node < n_body; ++node)
      {
        if (!surface->moves(node))
          continue;
        const auto add = [&](const BudgetTerm term, const dealii::Tensor<1, dim> &force) {
          acting[term].add(1., {force * surfaces.increment[node], dt * force});
        };
        add(BudgetTerm::interface, surfaces.on_bodies[node]);
        add(BudgetTerm::fluid_at_rest, surfaces.at_rest[node]);
        if (!surfaces.friction.empty())
          add(BudgetTerm::friction, surfaces.friction[node]);
      }
  }


  template <int dim>
  void
  Budget<dim>::add(const SolidBalance<dim> &solid)
  {
    const double dt = books.stage.length;
    books.gain.add(1., {solid.kinetic + solid.elastic + solid.contact_energy, solid.momentum});
    books.energy +=
      std::abs(solid.kinetic) + std::abs(solid.elastic) + std::abs(solid.contact_energy);
    books.energy_rounding += solid.energy_rounding;
    books.impulse_rounding += dt * solid.force_rounding;

    auto &acting = books.acting;
    acting[BudgetTerm::loads].add(1., {solid.loads, dt * solid.loads_force});
    acting[BudgetTerm::supports].add(1., {solid.supports, dt * solid.supports_force});
    acting[BudgetTerm::damping].add(1., {-solid.damping, dt * solid.damping_force});
    acting[BudgetTerm::contact].add(
      1.,
      {solid.contact - solid.contact_handed_on, dt * solid.contact_force - solid.contact_impulse});
    // Of the integrator's what goes on with the rates: the work of internal forces, and of damping
    // and inertia on a path that is not their own.
    const double goes_on = -solid.elastic_work - solid.damping_on_path - solid.inertia_on_path;
    acting[BudgetTerm::integrator].energy += goes_on;

    auto &amounts = books.amounts;
    amounts[BudgetTerm::contact].add(
      1., {solid.contact_energy + solid.contact_handed_on, solid.contact_impulse});
    amounts[BudgetTerm::integrator].add(
      1., {-solid.inertia_loss - solid.elastic_loss - goes_on, -solid.inertia_gap});
    for (unsigned int e = 0; e < models.effects.size(); ++e)
      if (const auto found = solid.loads_by_effect.find(models.effects[e]->name);
          found != solid.loads_by_effect.end())
        acting.by_effect[e] += found->second;
  }


  template <int dim>
  bool
  Budget<dim>::concerns(const BudgetTerm term) const
  {
    if (term < BudgetTerm::obstacles)
      return models.fluid != nullptr;
    if (term == BudgetTerm::obstacles)
      return models.surface &&
             (has_sleep || models.surface->surface().n_nodes() > models.surface->n_body_nodes());
    if (term < BudgetTerm::loads)
      return models.fluid && models.solid &&
             (term != BudgetTerm::friction || models.has_friction());
    if (term == BudgetTerm::integrator)
      return true;
    return models.solid && (has_contact || term != BudgetTerm::contact) &&
           (has_sleep || term != BudgetTerm::sleep);
  }


  template <int dim>
  typename Budget<dim>::Amount
  Budget<dim>::missing() const
  {
    Amount result = books.gain;
    for (const auto &term : books.amounts.terms)
      result.add(-1., term);
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
          columns.push_back({name, "J", books.amounts.by_effect[e]});
      }
  }


  template <int dim>
  Columns
  Budget<dim>::columns() const
  {
    if (!is_on())
      return {};
    auto    amounts = books.amounts;
    Columns result{{"energy gain", "J", books.gain.energy}};
    double  energies = std::abs(books.energy), impulses = books.impulse_of_fluid;
    for (const auto term : all_terms())
      if (concerns(term))
        {
          result.push_back({std::string("energy by ") + name(term), "J", amounts[term].energy});
          energies += std::abs(amounts[term].energy);
          impulses += amounts[term].momentum.norm();
        }
    add_effects(result);
    result.push_back({"energy closure",
                      "1",
                      relative(std::abs(missing().energy), energies + books.energy_rounding)});
    for (unsigned int axis = 0; axis < dim; ++axis)
      result.push_back(
        {std::string("momentum gain ") + char('x' + axis), "kg m/s", books.gain.momentum[axis]});
    for (const auto term : all_terms())
      if (concerns(term))
        for (unsigned int axis = 0; axis < dim; ++axis)
          result.push_back({std::string("momentum by ") + name(term) + " " + char('x' + axis),
                            "kg m/s",
                            amounts[term].momentum[axis]});
    result.push_back({"momentum closure",
                      "1",
                      relative(missing().momentum.norm(), impulses + books.impulse_rounding)});
    return result;
  }


  template class Budget<2>;
  template class Budget<3>;
} // namespace undine
