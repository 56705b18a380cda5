// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_state_state_h
#define undine_coupled_state_state_h

#include <undine/base/core/clock.h>
#include <undine/coupled/state/budget_amounts.h>
#include <undine/coupled/state/energy_account.h>
#include <undine/coupled/state/impulses.h>
#include <undine/coupled/state/sleep_state.h>
#include <undine/coupled/state/step_history.h>
#include <undine/fluid/grid/fluid_state.h>
#include <undine/particles/model/particle_state.h>
#include <undine/solid/assembly/contact.h>
#include <undine/solid/mesh/solid_state.h>

#include <deal.II/base/point.h>

#include <optional>
#include <vector>

namespace undine
{
  /// Everything that changes during a run, as plain data: a saved copy is a complete restart.
  /// During a run only a Scheme writes to it, but for the clock, which the loop over steps
  /// advances. Members that a scene does not need stay empty.
  template <int dim>
  struct State
  {
    Clock           clock;
    SolidState      solid;
    FluidState<dim> fluid;

    particles::ParticleState<dim> particles;

    /// Only within a step of stages that keep rates (Stage). @{
    SolidState                            stage_begin;   ///< the bodies at the begin of the stage
    dealii::TrilinosWrappers::MPI::Vector mean_velocity; ///< r of displacements [m/s]
    ContactStart                          contact;       ///< of the bodies in the stage
    /// @}

    /// Only within a step, if there is an EnergyMonitor: the bodies at its begin.
    SolidState step_begin;

    /// Positions of the nodes of ImmersedSurface when the fluid's fields were computed [m].
    std::vector<dealii::Point<dim>> surface_positions;

    /// Of the time that the state is at, for the budget of the next step, if it is kept.
    BudgetAmounts<dim> budget_rates;

    /// Of the time that the state is at, if there is an EnergyMonitor.
    std::optional<EnergyAccount> account;

    /// Of the fluid's forces, if they are asked for and there are surfaces in it.
    std::optional<Impulses<dim>> impulses;

    StepHistory<dim> history;
    SleepState<dim>  sleep;
  };
} // namespace undine

#endif
