// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/step/coupled_stage.h>
#include <undine/coupled/step/solid_side.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/operators/flux_matrix.h>
#include <undine/solid/assembly/sparse.h>
#include <undine/solid/step/initial_guesses.h>

#include <utility>

namespace undine
{
  namespace
  {
    /// The surface flux with the bodies at their first guess.
    template <int dim>
    std::unique_ptr<SurfaceFlux<dim>>
    moved(std::unique_ptr<SurfaceFlux<dim>> surface, const BlockSystem::Vector &velocity)
    {
      surface->move(velocity);
      return surface;
    }


    // What contact does is handed on to the next stage apart from the rest: an error in its share
    // changes the rates with which that goes on.
    constexpr double impulse_reduction = 1e-10;

    /// The error of B u if positions of the size of the domain are known to rounding only.
    template <int dim>
    double
    flux_rounding(const MacGrid<dim> &grid, const SurfaceFlux<dim> &surface, const double dt)
    {
      double size = 0;
      for (unsigned int d = 0; d < dim; ++d)
        size = std::max({size, std::abs(grid.lower()[d]), std::abs(grid.upper()[d])});
      return std::numeric_limits<double>::epsilon() * size / dt * surface.matrix().frobenius_norm();
    }
  } // namespace


  template <int dim>
  CoupledStage<dim>::CoupledStage(const Parts           &parts,
                                  const FluidStage<dim> &fluid,
                                  State<dim>            &state,
                                  const std::string     &boundary_flux)
    : parts(parts)
    , fluid(fluid)
    , state(state)
    , newton(parts.models.solid->numerics().newton)
    , end_time(fluid.end)
    , old_solid(state.solid)
    , equations(*parts.models.solid,
                parts.mass,
                old_solid,
                parts.environment,
                fluid.start,
                fluid.dt,
                parts.timing,
                loads_besides_pressure(),
                state.contact,
                begin_of(state, fluid.stage))
    , numbers(parts.models.fluid->grid(), parts.geometry.bodies().topology)
    , surface(
        moved(make_surface_flux(
                boundary_flux,
                parts.models,
                parts.geometry,
                numbers,
                equations,
                BodiesInStage<dim>(parts.models, state, fluid.stage, fluid.end - fluid.stage.end)),
              equations.guess()))
    , follower(make_follower())
    , pressures(*parts.models.fluid, numbers, filled_rows(surface->matrix()), fluid.dt)
    , problem(*parts.models.solid,
              equations,
              *surface,
              follower,
              pressures,
              parts.solver,
              parts.timing,
              flux_rounding(parts.models.fluid->grid(), *surface, fluid.dt))
    , x(problem.vector())
    , last_pressure(x.block(1))
  {
    copy_to_vector(last_pressure, state.fluid.pressure);
    pressures.start(state.fluid.velocity,
                    fluid.tracer.velocity(),
                    end_time,
                    surface->swept_volume_flux(fluid.dt));
    predicted = state.fluid.velocity;
  }


  /// By the pressure that is known before. In steps of one stage bodies end elsewhere than where
  /// the grid was cut on purpose.
  template <int dim>
  FollowerPressure<dim>
  CoupledStage<dim>::make_follower() const
  {
    if (!fluid.stage.keeps_rates())
      return FollowerPressure<dim>(*parts.models.surface);
    auto forces = surface->nodal_forces(state.fluid.pressure);
    for (std::size_t node = 0; node < forces.size(); ++node)
      forces[node] += surfaces.at_rest[node];
    return {*parts.models.surface, parts.geometry.surface_positions(), forces};
  }


  /// Loads of the fluid on the bodies other than its reduced pressure [N]. Friction has been found
  /// before: v* contains its reaction.
  template <int dim>
  typename CoupledStage<dim>::Vector
  CoupledStage<dim>::loads_besides_pressure()
  {
    surfaces.at_rest = parts.geometry.other_forces(fluid.gravity, end_time);
    auto result      = parts.models.solid->vector();
    parts.models.surface->add_to_bodies(result, surfaces.at_rest);
    if (fluid.friction)
      {
        surfaces.friction = fluid.friction->on_nodes;
        parts.models.surface->add_to_bodies(result, surfaces.friction);
      }
    return result;
  }


  /// Newton's method for u^{n+1} and p, and around it for the backflow through outflows (see
  /// stabilise_backflow()).
  template <int dim>
  SolidReport<dim>
  CoupledStage<dim>::solve(const Vector &found)
  {
    const auto       timed = parts.timing.section("couple");
    SolidReport<dim> report;
    parts.solver.start_step(pressures.places());
    if (newton.fixed_iterations > 0)
      // Every round begins anew, so that there are exactly so many corrections.
      find_entering_speeds(
        [&](const unsigned int) { return solve_round(report.newton, newton, found); });
    else
      {
        // No more accurate than the speeds are, before the last round.
        NewtonOptions rough      = newton;
        rough.relative_tolerance = std::max(newton.relative_tolerance, 1e-5);
        if (pressures.has_openings())
          find_entering_speeds(
            [&](const unsigned int n) { return solve_round(report.newton, rough, found, n > 0); });
        solve_round(report.newton, newton, found, pressures.has_openings());
      }
    report.note = parts.solver.note();
    end(report);
    return report;
  }


  /// Solves the equations with the last speeds of the backflow, from the guesses of the step or
  /// from where another round has ended. Returns by how much better speeds would change v^{n+1}.
  template <int dim>
  double
  CoupledStage<dim>::solve_round(NewtonReport        &report,
                                 const NewtonOptions &options,
                                 const Vector        &found,
                                 const bool           goes_on)
  {
    state.fluid.velocity = predicted;
    pressures.open(state.fluid.velocity);
    const auto rest = [&] {
      parts.motion_solver.begin_stage(equations.symmetry());
      return resting_guess(equations, parts.motion_solver, parts.timing);
    };
    const auto from = [&](const Vector &velocity) {
      return solve_from(velocity, last_pressure, options);
    };
    report.append(goes_on ? solve_from(x.block(0), x.block(1), options, problem.has_tangent())
                          : solve_from_guesses(equations, options, found, rest, from));
    pressures.accelerate(state.fluid.velocity, x.block(1));
    return pressures.update_backflow(state.fluid.velocity);
  }


  /// Newton's method from these guesses.
  template <int dim>
  NewtonReport
  CoupledStage<dim>::solve_from(const Vector        &velocity,
                                const Vector        &pressure,
                                const NewtonOptions &options,
                                const bool           has_tangent)
  {
    x.block(0) = equations.kept_apart(velocity);
    x.block(1) = pressure;
    pressures.closed_regions().fix_pressure_level(x.block(1));
    problem.start();
    return solve_newton(problem, x, options, has_tangent);
  }


  /// d^{n+1} from u^{n+1}, and what else follows.
  template <int dim>
  void
  CoupledStage<dim>::end(SolidReport<dim> &report)
  {
    const auto &velocity = x.block(0);
    surface->move(velocity);
    const auto pressure = pressures.field(x.block(1));
    on_nodes            = problem.nodal_forces(x);
    equations.add_forces(surface->on_bodies(on_nodes));
    reactions                 = equations.reactions(velocity);
    report.momentum_residuals = equations.momentum_residuals(velocity, reactions);
    divergence_left           = pressures.divergence(state.fluid.velocity, surface->fluxes());
    const auto before         = std::exchange(state.fluid.pressure, pressure);
    bodies_by_contact         = respond_to_contact();
    report.reactions          = equations.reactions_at_end(reactions, velocity, bodies_by_contact);
    if (parts.models.has_sleepers())
      pressures.closed_regions().keep_means(state.fluid.pressure, before);
    else
      pressures.closed_regions().remove_means(state.fluid.pressure);
    set_means(state.fluid.pressure, parts.models.fluid->grid());
    state.solid = equations.end_state(velocity, bodies_by_contact);
  }


  /// The velocities that forces of contact give to bodies and fluid together, as far as they are
  /// not kept as rates, with the inertia of both: light bodies move the fluid rather than
  /// themselves. Of the fluid's it takes note. What changes of them counts for the whole stage in
  /// its pressure; a pressure is a force per area and time (S21).
  template <int dim>
  ContactResponse
  CoupledStage<dim>::respond_to_contact()
  {
    const auto change = equations.change_of_contact(x.block(0));
    const auto beside = equations.contact_beside_rates(x.block(0));
    if (change.size() == 0 && beside.size() == 0)
      return {};
    const auto          timed = parts.timing.section("contact");
    BlockSystem::Matrix inertia;
    inertia.copy_from(parts.mass);
    inertia *= 1 / fluid.dt;
    fix_rows_and_columns(inertia, parts.models.solid->all_fixed());
    const BlockSystem system(inertia, surface->matrix(), surface->factor(), pressures.matrix());
    parts.impulse_solver.start_step(pressures.places());
    parts.impulse_solver.initialize(system, equations.displacement(x.block(0)));
    const auto response_to = [&](const Vector &forces) {
      auto right_side = problem.vector();
      if (forces.size() == 0)
        return right_side;
      right_side.block(0) = forces;
      return parts.impulse_solver.solve(right_side, impulse_reduction);
    };
    const auto by_change = response_to(change);
    auto       not_kept  = response_to(beside);
    if (equations.leaves_out_change())
      not_kept += by_change;
    fluid_by_contact = state.fluid.velocity;
    add(*fluid_by_contact, -1., state.fluid.velocity);
    pressures.accelerate(*fluid_by_contact, not_kept.block(1));
    const auto pressure = pressures.field(by_change.block(1));
    if (state.impulses)
      {
        forces_by_contact.by_change = parts.geometry.pressure_forces(pressure);
        forces_by_contact.not_kept =
          parts.geometry.pressure_forces(pressures.field(not_kept.block(1)));
      }
    ContactResponse result;
    result.velocity = not_kept.block(0);
    if (change.size() > 0)
      {
        add(state.fluid.pressure, -1., pressure);
        result.by_change = by_change.block(0);
      }
    result.pressures = surface->on_bodies(
      surface->nodal_forces(change.size() > 0 ? pressure : pressures.field(not_kept.block(1))));
    return result;
  }


  template <int dim>
  double
  CoupledStage<dim>::divergence() const
  {
    return divergence_left;
  }


  template <int dim>
  Field<dim>
  CoupledStage<dim>::pressure() const
  {
    return pressures.field(x.block(1));
  }


  template <int dim>
  PressureBalance<dim>
  CoupledStage<dim>::pressure_balance() const
  {
    return undine::pressure_balance(
      *parts.models.fluid, state.fluid.velocity, pressure(), pressures.open_faces());
  }


  template <int dim>
  SurfaceExchange<dim>
  CoupledStage<dim>::exchange() const
  {
    const auto pressure            = pressures.field(x.block(1));
    auto       result              = surfaces;
    result.by_fluid                = parts.geometry.pressure_forces(pressure);
    result.by_surface_flux         = surface->nodal_forces(pressure);
    result.velocities              = surface->node_velocities();
    result.power_beside_velocities = surface->power_beside_velocities(pressure);
    result.on_bodies               = on_nodes;
    result.increment               = parts.models.surface->with_bodies(
      equations.increment(x.block(0)),
      typename SurfaceExchange<dim>::Vectors(result.by_fluid.size()));
    return result;
  }


  template <int dim>
  SolidBalance<dim>
  CoupledStage<dim>::solid_balance() const
  {
    return equations.balance(x.block(0), reactions, bodies_by_contact.velocity);
  }


  template class CoupledStage<2>;
  template class CoupledStage<3>;
} // namespace undine
