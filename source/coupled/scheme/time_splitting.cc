// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/coupled/scheme/stepping_scheme.h>
#include <undine/coupled/step/fluid_side.h>
#include <undine/coupled/step/solid_side.h>
#include <undine/coupled/step/work_on_fluid.h>

#include <optional>

namespace undine
{
  /// Bodies in a fluid, one after the other; all else as in the simultaneous scheme. A step of
  /// length h from t^n:
  ///
  ///  1. fluid: transport, forces, implicit terms of every effect that is on; v^n becomes v*
  ///  2. bodies: Newton's method for u^{n+1} under the pressure p^n
  ///  3. fluid: projection between surfaces that move as the bodies did, for p^{n+1}; v* becomes
  ///     v^{n+1}
  template <int dim>
  class SplitPhysics : public Physics<dim>
  {
  public:
    SplitPhysics(const Models<dim> &models,
                 Budget<dim>       &budget,
                 TimingTree        &timing,
                 const std::string &driven_by)
      : Physics<dim>(models.communicator())
      , models(models)
      , budget(budget)
      , timing(timing)
      , driven_by(driven_by)
      , fluid_side(models, budget, timing)
      , solid_side(models, budget, timing)
      , projection(*models.fluid)
    {
    }

    void
    initialize(State<dim> &state, const double dt, Report &report) override
    {
      solid_side.initialize(state, dt, report);
      fluid_side.initialize(state, projection, dt, report);
      solid_side.add_columns(report, state, state.clock.time);
    }

    void
    solve_stage(State<dim> &state, const Stage &stage, Report &report) override
    {
      SurfaceExchange<dim> exchange;
      {
        const auto timed = timing.section("couple");
        // J p^n, where the grid was cut when p^n was computed.
        exchange.on_bodies = geometry_of(models, state)->pressure_forces(state.fluid.pressure);
      }
      budget.begin_stage(stage);
      solid_side.start(state, stage);
      const auto  fluid    = fluid_side.predict(state, stage, report);
      const auto &geometry = *fluid_side.geometry();
      exchange.at_rest     = geometry.other_forces(fluid->gravity, fluid->end);
      auto forces          = models.solid->vector();
      models.surface->add_to_bodies(forces, exchange.on_bodies);
      models.surface->add_to_bodies(forces, exchange.at_rest);
      if (fluid->friction)
        {
          exchange.friction = fluid->friction->on_nodes;
          models.surface->add_to_bodies(forces, exchange.friction);
        }

      auto       increment = state.solid.displacement;
      const auto solid     = solid_side.advance(state, stage, forces);
      increment.sadd(-1, 1, state.solid.displacement);
      solid_side.end(state, stage);
      exchange.increment   = models.surface->with_bodies(increment, still());
      exchange.velocities  = node_velocities(state, exchange.increment, fluid->dt);
      const auto projected = project(state, *fluid, exchange.velocities);
      if (budget.is_on())
        {
          const auto phase         = timing.section("measure");
          exchange.by_fluid        = geometry.pressure_forces(state.fluid.pressure);
          exchange.by_surface_flux = exchange.by_fluid;
          budget.add(
            projected.balance(*models.fluid, state.fluid), projected.before, state.fluid.velocity);
          budget.add(exchange);
          budget.add(*solid.balance);
        }
      report.linear_iterations += projected.iterations;
      const bool is_judged = stage.is_last && report.account;
      const auto pressure  = is_judged ? std::optional(state.fluid.pressure) : std::nullopt;
      fluid_side.finish(*fluid, state, report, projected.divergence);
      budget.end_stage();
      if (is_judged) // by the pressure that has acted: friction corrects it in the end
        {
          const auto phase = timing.section("measure");
          WorkOnFluid<dim>(models, fluid_side.geometry())
            .add(*report.account,
                 state,
                 fluid->end,
                 projected.balance(*models.fluid, state.fluid),
                 *pressure);
        }
      solid_side.finish(state, stage, solid, report);
    }

    std::vector<dealii::Tensor<1, dim>>
    loads_on_surfaces(const State<dim> &state, const double time) const override
    {
      return fluid_side.loads_on_surfaces(state, time);
    }

  private:
    using Vectors = typename SurfaceExchange<dim>::Vectors;

    /// Throws SolveError where bodies close off fluid, whose volume their motion does not conserve.
    typename Projection<dim>::Report
    project(State<dim> &state, const FluidStage<dim> &fluid, const Vectors &velocities)
    try
      {
        const auto phase = timing.section("project");
        return projection.project(state.fluid,
                                  fluid.tracer.velocity(),
                                  fluid.end,
                                  fluid.dt,
                                  fluid_side.geometry()->swept_volume_flux(velocities, fluid.dt));
      }
    catch (const NoOutletError &error)
      {
        throw SolveError(std::string(error.what()) +
                         " If bodies close this part off, time splitting has no solution. Try: "
                         "'Scheme = simultaneous'.");
      }

    /// Zero in all nodes of surfaces.
    Vectors
    still() const
    {
      return Vectors(models.surface->surface().n_nodes());
    }

    /// Velocities of the surfaces for the projection [m/s].
    Vectors
    node_velocities(const State<dim> &state, const Vectors &increment, const double dt) const
    {
      auto result = fluid_side.geometry()->surface_velocities();
      if (driven_by == "velocity")
        return models.surface->with_bodies(state.solid.velocity, result);
      for (std::size_t node = 0; node < models.surface->n_body_nodes(); ++node)
        result[node] = increment[node] / dt;
      return result;
    }

    const Models<dim> &models;
    Budget<dim>       &budget;
    TimingTree        &timing;
    const std::string  driven_by; ///< velocity | displacement
    FluidSide<dim>     fluid_side;
    SolidSide<dim>     solid_side;
    Projection<dim>    projection;
  };


  /// A reference for comparisons with the simultaneous scheme.
  template <int dim>
  class TimeSplitting : public SteppingScheme<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      SteppingScheme<dim>::add_options(options);
      options.section("Coupling")
        .add("Fluid driven by",
             driven_by,
             "",
             Allowed::one_of({"velocity", "displacement"}),
             "What moves the surfaces in the fluid: the bodies' velocity at the end of the step, "
             "or their "
             "displacement in it over its length.");
    }

  protected:
    /// Splitting is shown as it is.
    EnergyMonitor::Response
    response_to_created_energy() const override
    {
      return EnergyMonitor::Response::warn;
    }

    std::optional<double>
    own_growth(const SplittingStability &foretold) const override
    {
      return driven_by == "velocity" ? foretold.growth_by_velocity
                                     : foretold.growth_by_displacement;
    }

    std::unique_ptr<Physics<dim>>
    couple(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing) const override
    {
      return std::make_unique<SplitPhysics<dim>>(models, budget, timing, driven_by);
    }

  private:
    std::string driven_by = "velocity";
  };


  namespace
  {
    const RegisterForDimensions<Scheme, TimeSplitting>
      time_splitting("time_splitting",
                     "Bodies move under the last pressure, then the fluid follows them.");
  }
} // namespace undine
