// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/scheme/stepping_scheme.h>
#include <undine/coupled/step/coupled_stage.h>
#include <undine/coupled/step/fluid_side.h>
#include <undine/coupled/step/solid_side.h>
#include <undine/coupled/step/surface_placement.h>
#include <undine/coupled/step/work_on_fluid.h>

namespace undine
{
  /// The section `Coupling`.
  struct CouplingSettings
  {
    std::string         boundary_flux      = "initial"; ///< initial | swept
    double              friction_tolerance = 3e-3;      ///< see ViscousCoupling::defect()
    BlockSolverSettings solver;
  };


  /// Bodies in a fluid, solved together. A stage of length h from its start:
  ///
  ///  1. fluid: transport, forces, implicit terms of every effect that is on; v^n becomes v*
  ///  2. Newton's method for u^{n+1} and p                                     (CoupledEquations)
  ///  3. bodies: d^{n+1} from u^{n+1}; fluid: v^{n+1} = v* + h (rho V)^-1 D^T p
  ///
  /// Stages that keep rates cut the grid where bodies are expected at their end. If these come to
  /// another place, by more than a small part of a cell, the stage is solved again with the grid
  /// cut elsewhere (SurfacePlacement): else the fluid would have left, or entered, what it has not,
  /// and light bodies that shake from stage to stage would gain energy by that.
  ///
  /// Friction and the level of pressure that follows bodies (FollowerPressure) know the pressures
  /// of the stage before, and those of its first solution where the stage is solved again. Where
  /// bodies leave a stage so much faster or slower than these made friction expect that it would
  /// differ, the stage is solved again with the pressures found.
  template <int dim>
  class SimultaneousPhysics : public Physics<dim>
  {
  public:
    using SolidVector = typename SolidModel<dim>::Vector;

    SimultaneousPhysics(const Models<dim>      &models,
                        Budget<dim>            &budget,
                        TimingTree             &timing,
                        const CouplingSettings &settings)
      : Physics<dim>(models.communicator())
      , models(models)
      , budget(budget)
      , timing(timing)
      , settings(settings)
      , fluid_side(models, budget, timing)
      , solid_side(models, budget, timing)
      , solver(*models.solid, settings.solver)
      , motion_solver(*models.solid)
      , impulse_solver(*models.solid, settings.solver)
    {
    }

    void
    initialize(State<dim> &state, const double dt, Report &report) override
    {
      solid_side.initialize(state, dt, report);
      Projection<dim> projection(*models.fluid);
      fluid_side.initialize(state, projection, dt, report);
      add_solver_columns(report);
      solid_side.add_columns(report, state, state.clock.time);
    }

    void
    solve_stage(State<dim> &state, const Stage &stage, Report &report) override
    {
      if (stage.is_first)
        {
          report.stages_again = 0;
          most_iterations     = 0;
        }
      SolidVector found; // velocities of bodies in the last solution
      if (!stage.keeps_rates() && !models.has_friction())
        {
          solve_once(state, stage, report, found);
          return;
        }
      State<dim>            begin         = state;
      const Report          report_before = report;
      const Budget<dim>     budget_before = budget;
      SurfacePlacement<dim> placement(models);
      bool                  knows_pressure = false; ///< that of a solution of this stage
      bool                  is_corrected   = false; ///< friction
      const auto            go_back        = [&] {
        state = begin;
        budget.go_back_to(budget_before);
        go_back_to(report_before, report);
      };
      while (true)
        {
          if (!is_solved(state, stage, report, placement, found))
            {
              fluid_side.expect(placement.retreat());
              go_back();
              continue;
            }
          const auto cut_at = fluid_side.geometry()->surface_positions();
          // Stages of other integrators begin where the grid is cut.
          const auto places =
            stage.keeps_rates()
              ? models.surface->positions(state.solid, state.clock.time + stage.end)
              : cut_at;
          const bool is_placed = placement.accepts(cut_at, places, fluid_side.misplacement(places));
          if (is_placed && (is_corrected || placement.is_at_limit() ||
                            fluid_side.friction_defect() <= settings.friction_tolerance))
            return;
          fluid_side.expect(is_placed ? cut_at : placement.next(cut_at, places));
          // All later solutions start from the same pressures: with others each time, where bodies
          // come to would depend on more than where the grid is cut, and no place be found.
          if (is_placed || !knows_pressure)
            {
              knows_pressure            = true;
              begin.fluid.pressure      = state.fluid.pressure;
              begin.fluid.pressure_time = state.clock.time + stage.end;
              begin.solid.fluid_loads   = state.solid.fluid_loads;
            }
          if (is_placed)
            {
              is_corrected = true;
              placement.forget_places();
            }
          go_back();
        }
    }

    std::vector<dealii::Tensor<1, dim>>
    loads_on_surfaces(const State<dim> &state, const double time) const override
    {
      return fluid_side.loads_on_surfaces(state, time);
    }

  private:
    /// False if the stage has no solution where the grid was cut, and `placement` knows a place
    /// closer to one at which it has.
    bool
    is_solved(State<dim>                  &state,
              const Stage                 &stage,
              Report                      &report,
              const SurfacePlacement<dim> &placement,
              SolidVector                 &found)
    {
      try
        {
          solve_once(state, stage, report, found);
          return true;
        }
      catch (const SolveError &)
        {
          if (!placement.can_retreat())
            throw;
          return false;
        }
    }

    /// Before the stage is solved again. Iterations count.
    static void
    go_back_to(const Report &before, Report &report)
    {
      const auto newton = report.newton_iterations, linear = report.linear_iterations;
      const auto again         = report.stages_again;
      report                   = before;
      report.newton_iterations = newton;
      report.linear_iterations = linear;
      report.stages_again      = again + 1;
    }

    /// Begins with the velocities of bodies `found` before, unless these are empty, and leaves its
    /// own there.
    void
    solve_once(State<dim> &state, const Stage &stage, Report &report, SolidVector &found)
    {
      budget.begin_stage(stage);
      solid_side.start(state, stage);
      const auto        fluid = fluid_side.predict(state, stage, report);
      CoupledStage<dim> coupled({models,
                                 solid_side.mass(),
                                 solid_side.environment(),
                                 *fluid_side.geometry(),
                                 solver,
                                 motion_solver,
                                 impulse_solver,
                                 timing},
                                *fluid,
                                state,
                                settings.boundary_flux);
      const auto        solid = coupled.solve(found);
      most_iterations         = std::max(most_iterations, solver.most_iterations());
      found                   = coupled.velocity_of_bodies();
      solid_side.end(state, stage);
      fluid->by_contact        = coupled.velocity_by_contact();
      fluid->forces_by_contact = coupled.pressures_of_contact();
      balance(coupled, state);
      fluid_side.finish(*fluid, state, report, coupled.divergence());
      budget.end_stage();
      if (stage.is_last && report.account)
        add_work(*report.account, state, fluid->end, coupled);
      if (stage.is_last)
        add_solver_columns(report);
      solid_side.finish(state, stage, solid, report);
    }

    void
    add_work(EnergyAccount           &account,
             const State<dim>        &state,
             const double             time,
             const CoupledStage<dim> &step) const
    {
      const auto measured = timing.section("measure");
      WorkOnFluid<dim>(models, fluid_side.geometry())
        .add(account, state, time, step.pressure_balance(), step.pressure());
    }

    void
    balance(const CoupledStage<dim> &step, const State<dim> &state)
    {
      if (!budget.is_on())
        return;
      const auto measured = timing.section("measure");
      budget.add(step.pressure_balance(), step.velocity_before_pressures(), state.fluid.velocity);
      budget.add(step.exchange());
      budget.add(step.solid_balance());
    }

    void
    add_solver_columns(Report &report) const
    {
      append(report.columns,
             {{"Most iterations of a solve", "1", double(most_iterations)},
              {"Stages solved again", "1", double(report.stages_again)}});
    }

    const Models<dim>      &models;
    Budget<dim>            &budget;
    TimingTree             &timing;
    const CouplingSettings &settings;
    FluidSide<dim>          fluid_side;
    SolidSide<dim>          solid_side;
    BlockSolver<dim>        solver;
    TangentSolver<dim>      motion_solver;
    BlockSolver<dim>        impulse_solver;
    unsigned int            most_iterations = 0; ///< of one linear solve, in the step
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
        "boundary at its beginning, or by the volume that they sweep, exactly. For integrators of "
        "one stage: trapezoid_bdf2 has its own way, which keeps the volume of closed regions.");
      if (settings.boundary_flux != "initial" && this->has_stages())
        throw coupling.error("Boundary flux",
                             "it is a choice for integrators of one stage",
                             "Remove it: the integrator chosen in 'Time' keeps the volume of "
                             "closed regions by itself. Or choose another one, such as 'theta'.");
      if (this->has_stages())
        settings.boundary_flux = "swept"; // of steps that fall back: it keeps that volume, too
      coupling.add("Friction tolerance",
                   settings.friction_tolerance,
                   "1",
                   Allowed::not_negative(),
                   "Friction on bodies is found with the pressures of the stage before. Where it "
                   "would differ with the velocities that bodies then get, by more than this share "
                   "of the fluid's forces on them, the stage is solved once more with the "
                   "pressures found. 0: always.");
      settings.solver.add_options(coupling);
    }

  protected:
    bool
    solves_together() const override
    {
      return true;
    }

    std::unique_ptr<Physics<dim>>
    couple(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing) const override
    {
      return std::make_unique<SimultaneousPhysics<dim>>(models, budget, timing, settings);
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
