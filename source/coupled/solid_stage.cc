// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/solid_stage.h>

namespace undine
{
  namespace
  {
    /// The bodies go on for `length` [s] with the rates of `now`.
    template <int dim>
    void
    go_on(typename State<dim>::StageStart &start, const double length, const SolidState &now)
    {
      if (length == 0)
        return;
      start.solid.displacement.add(length, now.velocity);
      start.solid.velocity.add(length, now.acceleration);
      start.way.add(length, now.velocity);
    }
  } // namespace


  template <int dim>
  void
  start_stage(State<dim>           &state,
              const Stage          &stage,
              const SolidStep<dim> &step,
              Ledger<dim>          &ledger)
  {
    if (!stage.keeps_rates)
      return;
    if (ledger.is_on() && stage.is_first)
      ledger.start(step.amounts(state.solid));
    using Start     = typename State<dim>::StageStart;
    const auto  now = state.solid;
    const Start still{now,
                      dealii::TrilinosWrappers::MPI::Vector(now.velocity.locally_owned_elements(),
                                                            now.velocity.get_mpi_communicator())};
    Start       start = still;
    if (stage.is_first)
      go_on<dim>(start, stage.rate(), now);
    else
      start = state.next;
    state.solid = start.solid;
    state.way   = start.way;
    if (ledger.is_on() && stage.is_last)
      ledger.add(step.amounts(state.solid));
    if (stage.is_last)
      return;
    state.next = still;
    go_on<dim>(state.next, stage.next_old.length, now);
  }


  template <int dim>
  void
  end_stage(State<dim> &state, const Stage &stage)
  {
    if (!stage.keeps_rates)
      return;
    if (stage.is_last)
      state.next = {};
    else
      go_on<dim>(state.next, stage.next_new.length, state.solid);
  }


  template void
  start_stage(State<2> &, const Stage &, const SolidStep<2> &, Ledger<2> &);
  template void
  start_stage(State<3> &, const Stage &, const SolidStep<3> &, Ledger<3> &);
  template void
  end_stage(State<2> &, const Stage &);
  template void
  end_stage(State<3> &, const Stage &);
} // namespace undine
