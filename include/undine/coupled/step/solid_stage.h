// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_solid_stage_h
#define undine_coupled_step_solid_stage_h

#include <undine/base/core/stage.h>
#include <undine/coupled/budget/ledger.h>
#include <undine/coupled/state/state.h>
#include <undine/solid/step/solid_step.h>

namespace undine
{
  /// The bodies of `state` become those from which the stage of the step from t^n starts, and what
  /// its step needs of them for the stage that follows is put aside; the ledger, if it is on,
  /// learns of it. Nothing if the stage keeps no rates. Collective.
  template <int dim>
  void
  start_stage(State<dim>                  &state,
              const Stage                 &stage,
              const SolidStep<dim>        &step,
              const SolidEnvironment<dim> &environment,
              Ledger<dim>                 &ledger);

  /// The bodies of `state` are those at the end of the stage, as `report` says: add their rates,
  /// and what contact did, to the start of the one that follows.
  template <int dim>
  void
  end_stage(State<dim> &state, const Stage &stage, const SolidReport<dim> &report);
} // namespace undine

#endif
