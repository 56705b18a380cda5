// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/step/single_physics.h>
#include <undine/coupled/step/solid_stage.h>
#include <undine/solid/step/solid_columns.h>

namespace undine
{
  template <int dim>
  SolidAlone<dim>::SolidAlone(const Models<dim> &models, Ledger<dim> &ledger, TimingTree &timing)
    : model(*models.solid)
    , ledger(ledger)
    , timing(timing)
    , environment(models.environment())
    , solid_step(model)
  {
    if (ledger.is_on())
      solid_step.keep_balance();
  }


  template <int dim>
  void
  SolidAlone<dim>::initialize(State<dim> &state, const double dt, Report &report)
  {
    const double time = state.clock.time;
    state.solid       = solid_step.initialize(environment, time, dt);
    const SolidReport<dim> no_step;
    append(report.columns,
           solid_columns(model, solid_step, environment, state.solid, time, no_step));
  }


  template <int dim>
  void
  SolidAlone<dim>::step(State<dim> &state, const Stage &stage, Report &report)
  {
    const double time = state.clock.time;
    start_stage(state, stage, solid_step, environment, ledger);
    const auto solid = solid_step.step(
      state.solid, environment, time + stage.start(), stage.length, timing, {}, state.contact);
    end_stage(state, stage, solid);
    if (solid.balance && stage.is_last)
      ledger.add(*solid.balance, stage.length);
    report.newton_iterations += solid.newton.iterations;
    report.linear_iterations += solid.newton.linear_iterations;
    report.newton_reduction = reduction(solid.newton);
    report.note             = solid.note;
    if (!stage.is_last)
      return;
    const auto measured = timing.section("measure");
    append(report.columns,
           solid_columns(model, solid_step, environment, state.solid, time + stage.end, solid));
  }


  template class SolidAlone<2>;
  template class SolidAlone<3>;
} // namespace undine
