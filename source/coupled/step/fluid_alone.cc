// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/step/fluid_alone.h>
#include <undine/coupled/step/work_on_fluid.h>

#include <optional>
#include <utility>

namespace undine
{
  template <int dim>
  FluidAlone<dim>::FluidAlone(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing)
    : Physics<dim>(models.communicator())
    , models(models)
    , model(*models.fluid)
    , budget(budget)
    , timing(timing)
    , fluid_side(models, budget, timing)
    , projection(*models.fluid)
    , keeps_levels(models.has_sleepers())
    , loads_bodies(models.direction != Direction::body_to_fluid)
  {
  }


  template <int dim>
  void
  FluidAlone<dim>::initialize(State<dim> &state, const double dt, Report &report)
  {
    fluid_side.initialize(state, projection, dt, report);
  }


  /// The first stage of a run with friction is solved twice: friction has to know the pressure,
  /// which holds what may act from the start, or it slows down what the pressure will not let flow.
  template <int dim>
  void
  FluidAlone<dim>::solve_stage(State<dim> &state, const Stage &stage, Report &report)
  {
    if (stage.is_first && state.clock.step == 0 && models.has_friction())
      {
        State<dim> begin         = state;
        Report     report_before = report;
        const auto budget_before = budget;
        solve_once(state, stage, report);
        begin.fluid.pressure            = state.fluid.pressure;
        begin.fluid.pressure_time       = state.clock.time + stage.end;
        report_before.linear_iterations = report.linear_iterations;
        state                           = std::move(begin);
        report                          = std::move(report_before);
        budget.go_back_to(budget_before);
      }
    solve_once(state, stage, report);
  }


  template <int dim>
  void
  FluidAlone<dim>::solve_once(State<dim> &state, const Stage &stage, Report &report)
  {
    const auto timed = timing.section("fluid");
    budget.begin_stage(stage);
    const auto fluid    = fluid_side.predict(state, stage, report);
    const auto geometry = fluid_side.geometry();

    typename Projection<dim>::Report projected;
    {
      const auto phase  = timing.section("project");
      const auto before = keeps_levels ? std::optional(state.fluid.pressure) : std::nullopt;
      projected =
        projection.project(state.fluid,
                           fluid->tracer.velocity(),
                           fluid->end,
                           fluid->dt,
                           geometry ? geometry->swept_volume_flux(fluid->dt) : SweptVolumeFlux());
      if (before)
        projection.keep_levels(state.fluid.pressure, *before);
    }
    if (budget.is_on())
      balance(state, projected);
    report.linear_iterations += projected.iterations;
    const bool is_judged = stage.is_last && report.account;
    const auto pressure  = is_judged ? std::optional(state.fluid.pressure) : std::nullopt;
    const auto balanced =
      is_judged ? std::optional(projected.balance(model, state.fluid)) : std::nullopt;
    fluid_side.finish(*fluid, state, report, projected.divergence);
    budget.end_stage();
    if (!is_judged)
      return;
    const auto phase = timing.section("measure");
    WorkOnFluid<dim>(models, fluid_side.geometry())
      .add(*report.account, state, fluid->end, *balanced, *pressure);
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  FluidAlone<dim>::loads_on_surfaces(const State<dim> &state, const double time) const
  {
    if (!loads_bodies)
      return {}; // as bodies that are awake get: what sleeps wakes of its own loads alone
    return fluid_side.loads_on_surfaces(state, time);
  }


  template <int dim>
  void
  FluidAlone<dim>::balance(const State<dim>                       &state,
                           const typename Projection<dim>::Report &projected)
  {
    const auto phase = timing.section("measure");
    budget.add(projected.balance(model, state.fluid), projected.before, state.fluid.velocity);
    if (const auto *geometry = fluid_side.geometry())
      {
        SurfaceExchange<dim> exchange;
        exchange.by_fluid        = geometry->pressure_forces(state.fluid.pressure);
        exchange.by_surface_flux = exchange.by_fluid;
        exchange.velocities      = geometry->surface_velocities();
        budget.add(exchange);
      }
  }


  template class FluidAlone<2>;
  template class FluidAlone<3>;
} // namespace undine
