// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/step/solid_stage.h>

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


    /// The bodies of `state` are those at the begin of the stage.
    template <int dim>
    void
    start_contact(State<dim>                  &state,
                  const Stage                 &stage,
                  const SolidEnvironment<dim> &environment,
                  const bool                   keeps_energy)
    {
      if (!environment.contact)
        return;
      auto &contact       = state.contact;
      contact.place       = state.solid.displacement;
      contact.time        = state.clock.time + stage.begin;
      contact.weight      = stage.way() / stage.length;
      contact.keeps_rates = true;
      if (stage.is_first)
        contact.old_energy.reset();
      if (stage.is_first && keeps_energy)
        contact.old_energy = environment.contact->energy(contact.place, contact.time);
    }
  } // namespace


  template <int dim>
  void
  start_stage(State<dim>                  &state,
              const Stage                 &stage,
              const SolidStep<dim>        &step,
              const SolidEnvironment<dim> &environment,
              Ledger<dim>                 &ledger)
  {
    if (!stage.keeps_rates)
      return;
    start_contact(state, stage, environment, ledger.is_on());
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
  end_stage(State<dim> &state, const Stage &stage, const SolidReport<dim> &report)
  {
    if (!stage.keeps_rates)
      return;
    state.contact.place.clear();
    if (stage.is_last)
      {
        state.next = {};
        return;
      }
    go_on<dim>(state.next, stage.next_new.length, state.solid);
    if (report.contact_velocity.size() > 0)
      state.next.solid.velocity.add(1., report.contact_velocity);
  }


  template void
  start_stage(
    State<2> &, const Stage &, const SolidStep<2> &, const SolidEnvironment<2> &, Ledger<2> &);
  template void
  start_stage(
    State<3> &, const Stage &, const SolidStep<3> &, const SolidEnvironment<3> &, Ledger<3> &);
  template void
  end_stage(State<2> &, const Stage &, const SolidReport<2> &);
  template void
  end_stage(State<3> &, const Stage &, const SolidReport<3> &);
} // namespace undine
