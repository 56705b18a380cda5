// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/step/work_on_fluid.h>
#include <undine/fluid/model/fluid_quantities.h>
#include <undine/operators/body_forces.h>
#include <undine/operators/outside_forces.h>
#include <undine/operators/static_pressure.h>

#include <algorithm>
#include <utility>

namespace undine
{
  template <int dim>
  bool
  is_carried(const Models<dim> &models)
  {
    return std::any_of(models.effects.begin(), models.effects.end(), [](const auto &effect) {
      return effect->name == "convection";
    });
  }


  template <int dim>
  WorkOnFluid<dim>::WorkOnFluid(const Models<dim> &models, const FluidGeometry<dim> *cut)
    : models(models)
    , model(*models.fluid)
    , gravity(models.requests_of_effects().gravity)
    , cut(cut)
  {
  }


  template <int dim>
  double
  WorkOnFluid<dim>::friction_of_obstacles(const FluidStage<dim> &fluid) const
  {
    double power = 0;
    if (fluid.friction && cut)
      for (std::size_t node = models.surface->n_body_nodes(); node < fluid.wall_velocities.size();
           ++node)
        power -= fluid.friction->on_nodes[node] * fluid.wall_velocities[node];
    return power;
  }


  template <int dim>
  void
  WorkOnFluid<dim>::add(EnergyAccount              &account,
                        const State<dim>           &state,
                        const double                time,
                        const PressureBalance<dim> &pressures,
                        const Field<dim>           &pressure) const
  {
    const bool   has_bodies = cut && models.solid && models.surface->n_body_nodes() > 0;
    const double level = has_bodies && cut->has_void_regions() ? 0 : pressures.mean_at_openings;
    // What flows in of a fluid of constant volume goes out, or is the way that bodies make for it,
    // against which the level does work: that follows from where they have come to.
    account.add_power(pressures.power_of_sides - level * pressures.inflow_of_sides);
    account.add_power(pressures.power_of_openings - level * pressures.inflow_of_openings);
    if (cut)
      {
        const auto        velocities = cut->surface_velocities();
        const std::size_t n_bodies   = models.surface->n_body_nodes();
        const auto        are_still  = [](const auto &velocity) { return velocity.norm() == 0; };
        if (!std::all_of(velocities.begin() + n_bodies, velocities.end(), are_still))
          {
            const auto forces   = cut->pressure_forces(pressure);
            const auto of_level = cut->uniform_pressure_forces(1);
            double     power = 0, pushed = 0;
            for (std::size_t node = n_bodies; node < velocities.size(); ++node)
              {
                power -= forces[node] * velocities[node];
                pushed -= of_level[node] * velocities[node];
              }
            account.add_power(power - level * pushed);
          }
        if (!is_carried(models))
          account.add_doubtful_power(kinetic_energy_of_way_made(state));
      }
    if (has_bodies)
      add_work_on_bodies(account, state, time, level);
  }


  /// Where convection does not carry the fluid along, what makes way for it gives it kinetic
  /// energy, and what moves into it takes it away, although nothing does work:
  ///
  ///     int_Gamma rho |v|^2 / 2 u.n dGamma    [W],    (B5)
  ///
  /// n out of the fluid, with the velocities u of all surfaces. In gaps that close it is far larger
  /// at the end of a step than in the mean.
  template <int dim>
  double
  WorkOnFluid<dim>::kinetic_energy_of_way_made(const State<dim> &state) const
  {
    auto velocities = cut->surface_velocities();
    if (models.solid)
      velocities = models.surface->with_bodies(state.solid.velocity, std::move(velocities));
    if (std::all_of(velocities.begin(), velocities.end(), [](const auto &velocity) {
          return velocity.norm() == 0;
        }))
      return 0;
    const auto forces = cut->pressure_forces(kinetic_energy_densities(model, state.fluid.velocity));
    double     power  = 0;
    for (std::size_t node = 0; node < velocities.size(); ++node)
      power += forces[node] * velocities[node];
    return power;
  }


  /// The pressure of the fluid at rest at the height of the openings: a uniform one, which does no
  /// work on the fluid. Its work and that of weight follow from where bodies have come to. Where
  /// bodies bound void regions, the power of the forces at the end of the step stands for it.
  template <int dim>
  void
  WorkOnFluid<dim>::add_work_on_bodies(EnergyAccount    &account,
                                       const State<dim> &state,
                                       const double      time,
                                       const double      level) const
  {
    const auto &surface = *models.surface;
    if (cut->has_void_regions())
      {
        // Bodies that sleep have nodes, too, which do not move.
        const auto velocities =
          surface.with_bodies(state.solid.velocity,
                              typename FluidGeometry<dim>::Velocities(surface.surface().n_nodes()));
        const auto forces = cut->other_forces(gravity, time);
        double     power  = 0;
        for (unsigned int node = 0; node < surface.n_body_nodes(); ++node)
          power += forces[node] * velocities[node];
        account.add_power(power);
        return;
      }
    const auto before = surface.positions(state.step_begin, state.clock.time);
    const auto now    = surface.positions(state.solid, time);
    const auto work   = [&](const double pressure) {
      const auto against = [&](const auto &positions) {
        return work_against(StaticPressure<dim>{pressure, model.density() * gravity},
                            model.grid(),
                            surface.surface(),
                            positions,
                            surface.n_body_nodes());
      };
      return against(before) - against(now);
    };
    const double at_end = work(level);
    const double at_begin =
      state.account && state.account->level ? work(*state.account->level) : at_end;
    const auto outside = works_outside(state, time);
    account.level      = level;
    account.add_work((at_begin + at_end + outside[0] + outside[1]) / 2, at_end + outside[1]);
  }


  /// The work of what acts on bodies outside of openings, with its pressures at the begin and at
  /// the end of the step [J].
  template <int dim>
  std::array<double, 2>
  WorkOnFluid<dim>::works_outside(const State<dim> &state, const double time) const
  {
    const auto &surface = *models.surface;
    const auto  before  = surface.positions(state.step_begin, state.clock.time);
    const auto  now     = surface.positions(state.solid, time);
    const auto  work    = [&](const double at) {
      const auto against = [&](const auto &positions) {
        return work_outside(model.boundaries(),
                            surface.surface(),
                            positions,
                            surface.n_body_nodes(),
                            model.density() * gravity,
                            at);
      };
      return against(before) - against(now);
    };
    return {{work(state.clock.time), work(time)}};
  }


  template bool
  is_carried(const Models<2> &);
  template bool
  is_carried(const Models<3> &);
  template class WorkOnFluid<2>;
  template class WorkOnFluid<3>;
} // namespace undine
