// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/step/solid_alone.h>

namespace undine
{
  template <int dim>
  SolidAlone<dim>::SolidAlone(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing)
    : Physics<dim>(models.communicator())
    , budget(budget)
    , solid_side(models, budget, timing)
  {
  }


  template <int dim>
  void
  SolidAlone<dim>::initialize(State<dim> &state, const double dt, Report &report)
  {
    solid_side.initialize(state, dt, report);
    solid_side.add_columns(report, state, state.clock.time);
  }


  template <int dim>
  void
  SolidAlone<dim>::solve_stage(State<dim> &state, const Stage &stage, Report &report)
  {
    budget.begin_stage(stage);
    solid_side.start(state, stage);
    const auto solid = solid_side.advance(state, stage);
    solid_side.end(state, stage);
    if (solid.balance)
      budget.add(*solid.balance);
    budget.end_stage();
    solid_side.finish(state, stage, solid, report);
  }


  template class SolidAlone<2>;
  template class SolidAlone<3>;
} // namespace undine
