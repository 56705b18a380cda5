// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/coupled_equations.h>
#include <undine/coupled/fluid_side.h>
#include <undine/coupled/stepping_scheme.h>
#include <undine/interface/flux_matrix.h>
#include <undine/solid/solid_columns.h>
#include <undine/solid/solid_step.h>
#include <undine/solid/tangent_solver.h>

namespace undine
{
  /// The section `Coupling`.
  struct CouplingSettings
  {
    std::string         boundary_flux = "initial"; ///< initial | swept
    BlockSolverSettings solver;
  };


  /// Bodies in a fluid, solved together. A step of length h from t^n:
  ///
  ///  1. fluid: transport, forces, implicit terms of every effect that is on; v^n becomes v*
  ///  2. Newton's method for u^{n+1} and p                                     (CoupledEquations)
  ///  3. bodies: d^{n+1} from u^{n+1}; fluid: v^{n+1} = v* + h (rho V)^-1 D^T p
  template <int dim>
  class SimultaneousPhysics : public Physics<dim>
  {
  public:
    SimultaneousPhysics(const Models<dim>      &models,
                        TimingTree             &timing,
                        const CouplingSettings &settings)
      : models(models)
      , timing(timing)
      , settings(settings)
      , environment(models.environment())
      , fluid_side(models, timing)
      , solid_step(*models.solid)
      , solver(*models.solid, settings.solver)
      , motion_solver(*models.solid)
    {
    }

    void
    initialize(State<dim> &state, const double dt, Report &report) override
    {
      state.solid = solid_step.initialize(environment, state.clock.time, dt);
      Projection<dim> projection(*models.fluid);
      fluid_side.initialize(state, projection, dt, report);
      add_solid_columns(report, state, state.clock.time, {});
    }

    void
    step(State<dim> &state, Report &report) override
    {
      const auto  fluid = fluid_side.predict(state, report.dt);
      double      divergence;
      SolidReport solid;
      {
        const auto timed = timing.section("couple");
        solid            = couple(state, *fluid, divergence);
      }
      report.newton_iterations += solid.newton.iterations;
      report.linear_iterations += solid.newton.linear_iterations;
      report.note           = solid.note;
      const auto &residuals = solid.newton.residuals;
      if (!residuals.empty() && residuals.front() > 0)
        report.newton_reduction = residuals.back() / residuals.front();
      fluid_side.finish(*fluid, state, report, divergence);
      add_solid_columns(report, state, fluid->time + fluid->dt, solid);
    }

  private:
    using Vector = BlockSystem::Vector;

    /// What the fluid does to the bodies besides its reduced pressure [N].
    Vector
    other_forces(const FluidStep<dim> &fluid) const
    {
      auto       result = models.solid->vector();
      const auto nodal  = fluid_side.geometry()->other_forces(fluid.gravity, fluid.time + fluid.dt);
      models.surface->add_to_bodies(result, nodal);
      return result;
    }

    SolidReport
    couple(State<dim> &state, const FluidStep<dim> &fluid, double &divergence)
    {
      const auto                &geometry = *fluid_side.geometry();
      const double               end      = fluid.time + fluid.dt;
      SolidEquations<dim>        equations(*models.solid,
                                    solid_step.mass(),
                                    state.solid,
                                    environment,
                                    fluid.time,
                                    fluid.dt,
                                    timing,
                                    other_forces(fluid));
      const PressureNumbers<dim> numbers(models.fluid->grid(), geometry.bodies().open_parts);
      const auto                 surface =
        make_surface_flux(settings.boundary_flux, models, geometry, numbers, equations, fluid.dt);
      const auto guess = equations.guess();
      surface->move(guess);
      PressureEquations<dim> pressures(
        *models.fluid, numbers, filled_rows(surface->matrix()), fluid.dt);
      pressures.start(state.fluid.velocity,
                      fluid.flow.velocity(),
                      end,
                      geometry.pushed(surface->node_velocities(), fluid.dt));

      CoupledEquations<dim> problem(*models.solid, equations, *surface, pressures, solver, timing);
      auto                  x = problem.vector();
      SolidReport           report;
      solver.start_step();
      report.newton = solve(x, state, problem, pressures, equations);
      report.note   = solver.note();

      const auto &velocity = x.block(0), &pressure = x.block(1);
      surface->move(velocity);
      equations.add_forces(surface->forces(pressures.field(pressure)));
      report.reactions          = equations.reactions(velocity);
      report.momentum_residuals = equations.momentum_residuals(velocity, report.reactions);
      divergence                = pressures.divergence(state.fluid.velocity, surface->fluxes());
      state.fluid.pressure      = pressures.field(pressure);
      pressures.closed_regions().remove_means(state.fluid.pressure);
      set_means(state.fluid.pressure, models.fluid->grid());
      state.solid = equations.end_state(velocity);
      return report;
    }

    /// Newton's method for u^{n+1} and p, and around it for how fast fluid enters through outflows:
    /// once or twice, as long as that changes v^{n+1} (see hold_back_entering_flow()).
    NewtonReport
    solve(BlockSystem::BlockVector  &x,
          State<dim>                &state,
          CoupledEquations<dim>     &problem,
          PressureEquations<dim>    &pressures,
          const SolidEquations<dim> &equations)
    {
      constexpr unsigned int most_rounds = 20;
      constexpr double       tolerance   = 1e-4;
      const auto             predicted   = state.fluid.velocity;
      NewtonReport           all;
      for (unsigned int round = 0; round < most_rounds; ++round)
        {
          state.fluid.velocity = predicted;
          pressures.open(state.fluid.velocity);
          const auto report = round == 0 ? solve_first(x, state, problem, equations)
                                         : solve_newton(problem, x, newton());
          all.iterations += report.iterations;
          all.linear_iterations = report.linear_iterations;
          all.residuals.insert(
            all.residuals.end(), report.residuals.begin(), report.residuals.end());
          pressures.accelerate(state.fluid.velocity, x.block(1));
          if (pressures.update_entering_flow(state.fluid.velocity) <= tolerance)
            break;
        }
      return all;
    }

    /// From u^n and p^n; if that fails, from bodies that keep their place.
    NewtonReport
    solve_first(BlockSystem::BlockVector  &x,
                const State<dim>          &state,
                CoupledEquations<dim>     &problem,
                const SolidEquations<dim> &equations)
    {
      copy_to_vector(x.block(1), state.fluid.pressure);
      if (newton().fixed_iterations == 0)
        try
          {
            x.block(0) = equations.guess();
            return solve_newton(problem, x, newton());
          }
        catch (const SolveError &)
          {
          }
      x.block(0) = resting_guess(equations);
      copy_to_vector(x.block(1), state.fluid.pressure);
      return solve_newton(problem, x, newton());
    }

    /// u that keeps d^n, but for what supports that have moved draw with them, as without a fluid.
    Vector
    resting_guess(const SolidEquations<dim> &equations)
    {
      auto velocity = equations.guess_at_rest();
      if (equations.has_motion())
        {
          const auto system = equations.motion_predictor();
          motion_solver.start_counting();
          velocity.add(1.,
                       motion_solver.solve(
                         system.matrix, system.right_side, equations.displacement(velocity)));
        }
      return velocity;
    }

    const NewtonOptions &
    newton() const
    {
      return models.solid->numerics().newton;
    }

    void
    add_solid_columns(Report            &report,
                      const State<dim>  &state,
                      const double       time,
                      const SolidReport &solid) const
    {
      const auto measured = timing.section("measure");
      report.columns.push_back(
        {"Most iterations of a solve", "1", double(solver.most_iterations())});
      append(report.columns,
             solid_columns(*models.solid, solid_step, environment, state.solid, time, solid));
    }

    const Models<dim>          &models;
    TimingTree                 &timing;
    const CouplingSettings     &settings;
    const SolidEnvironment<dim> environment;
    FluidSide<dim>              fluid_side;
    SolidStep<dim>              solid_step;
    BlockSolver<dim>            solver;
    TangentSolver<dim>          motion_solver;
  };


  /// The main scheme.
  template <int dim>
  class Simultaneous : public SteppingScheme<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      SteppingScheme<dim>::add_options(options);
      const auto coupling = options.section("Coupling");
      coupling.add(
        "Boundary flux",
        settings.boundary_flux,
        "",
        Allowed::one_of({"initial", "swept"}),
        "How bodies push the fluid: by their velocity at the end of a step through their "
        "boundary at its beginning, or by the volume that they sweep, exactly.");
      settings.solver.add_options(coupling);
    }

  protected:
    std::unique_ptr<Physics<dim>>
    couple(const Models<dim> &models, TimingTree &timing) const override
    {
      return std::make_unique<SimultaneousPhysics<dim>>(models, timing, settings);
    }

  private:
    CouplingSettings settings;
  };


  namespace
  {
    const RegisterForDimensions<Scheme, Simultaneous>
      simultaneous("simultaneous", "Fluid pressures and velocities of bodies are solved together.");
  }
} // namespace undine
