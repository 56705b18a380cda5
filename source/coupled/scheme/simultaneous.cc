// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/aitken_relaxation.h>
#include <undine/coupled/scheme/stepping_scheme.h>
#include <undine/coupled/step/coupled_stage.h>
#include <undine/coupled/step/fluid_side.h>
#include <undine/coupled/step/solid_side.h>

#include <fmt/format.h>

namespace undine
{
  /// The section `Coupling`.
  struct CouplingSettings
  {
    std::string         boundary_flux = "initial"; ///< initial | swept
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
  /// cut there, and then where AitkenRelaxation expects them: else the fluid would have left, or
  /// entered, what it has not, and light bodies that shake from stage to stage would gain energy by
  /// that.
  template <int dim>
  class SimultaneousPhysics : public Physics<dim>
  {
  public:
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
      solid_side.initialize(state, dt);
      Projection<dim> projection(*models.fluid);
      fluid_side.initialize(state, projection, dt, report);
      add_solver_columns(report);
      solid_side.add_columns(report, state, state.clock.time);
    }

    void
    solve_stage(State<dim> &state, const Stage &stage, Report &report) override
    {
      if (stage.is_first)
        report.stages_again = 0;
      if (!stage.keeps_rates())
        {
          solve_once(state, stage, report);
          return;
        }
      const State<dim>          begin         = state;
      const Report              report_before = report;
      const Budget<dim>         budget_before = budget;
      const auto                cut_at = [&] { return fluid_side.geometry()->surface_positions(); };
      AitkenRelaxation<dim>     relaxation;
      auto                      best   = cut_at();
      double                    lowest = std::numeric_limits<double>::infinity();
      std::vector<Misplacement> misplacements;
      for (unsigned int round = 0;; ++round)
        {
          solve_once(state, stage, report);
          const auto places = models.surface->positions(state.solid, state.clock.time + stage.end);
          misplacements.push_back(fluid_side.misplacement(places));
          const double cells = misplacements.back().cells;
          if (cells <= (round < most_rounds ? small_misplacement : largest_misplacement))
            return;
          if (cells < lowest)
            {
              lowest = cells;
              best   = cut_at();
            }
          if (round >= most_rounds && lowest > largest_misplacement)
            throw SolveError(misplacement_complaint(models, places, misplacements));
          const auto newton = report.newton_iterations, linear = report.linear_iterations;
          report                   = report_before;
          report.newton_iterations = newton;
          report.linear_iterations = linear;
          report.stages_again += round + 1;
          fluid_side.expect(round < most_rounds ? relaxation.next(cut_at(), places) : best);
          state = begin;
          budget.go_back_to(budget_before);
        }
    }

    std::vector<dealii::Tensor<1, dim>>
    loads_on_surfaces(const State<dim> &state, const double time) const override
    {
      return fluid_side.loads_on_surfaces(state, time);
    }

  private:
    // In cells. Bodies are where they are expected to second order in the step: steps that resolve
    // what happens stay below the first, up to which also thin bodies under large pressures get no
    // energy worth mentioning from the difference. Beyond the second, which steps of a body that
    // shakes exceed however often they are solved again, the fluid has lost or gained volume that
    // matters.
    static constexpr double       small_misplacement   = 0.01;
    static constexpr double       largest_misplacement = 0.3;
    static constexpr unsigned int most_rounds          = 6;

    void
    solve_once(State<dim> &state, const Stage &stage, Report &report)
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
      const auto        solid = coupled.solve();
      solid_side.end(state, stage);
      fluid->by_contact = coupled.velocity_by_contact();
      balance(coupled, state, solid);
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
      fluid_side.add_work(account, state, time, step.pressure_balance());
    }

    void
    balance(const CoupledStage<dim> &step, const State<dim> &state, const SolidReport<dim> &solid)
    {
      if (!budget.is_on())
        return;
      const auto measured = timing.section("measure");
      budget.add(step.pressure_balance(), step.velocity_before_pressures(), state.fluid.velocity);
      budget.add(step.exchange());
      budget.add(step.solid_balance(solid));
    }

    void
    add_solver_columns(Report &report) const
    {
      append(report.columns,
             {{"Most iterations of a solve", "1", double(solver.most_iterations())},
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
      settings.solver.add_options(coupling);
    }

  protected:
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
