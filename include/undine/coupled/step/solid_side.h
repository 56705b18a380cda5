// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_solid_side_h
#define undine_coupled_step_solid_side_h

#include <undine/coupled/budget/budget.h>
#include <undine/coupled/immersed/begin_of.h>
#include <undine/coupled/state/report.h>
#include <undine/coupled/state/state.h>
#include <undine/solid/step/solid_stepper.h>

namespace undine
{
  /// The part of a stage that the bodies go through in every scheme: all but the loads of the fluid
  /// on them. The counterpart of FluidSide.
  template <int dim>
  class SolidSide
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;

    /// The references must outlive it. Collective.
    SolidSide(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing);

    /// The bodies at the time of the state's clock, with a warning if contact pushes them already.
    /// `dt` [s] is the length of the first step. Collective.
    void
    initialize(State<dim> &state, double dt, Report &report) const;

    /// The bodies of `state` become those from which the stage of the step from t^n starts, their
    /// values at its begin gone on with the rates that were kept; the budget, if it is on, gets
    /// their energy and momentum. A stage that keeps no rates needs none, but accelerations anew if
    /// those of the state are not those of the integrator. Collective.
    void
    start(State<dim> &state, const Stage &stage) const;

    /// Solve for the bodies alone under nodal `forces` [N] (empty: none), from start() to end().
    /// Collective. Throws SolveError.
    SolidReport<dim>
    advance(State<dim> &state, const Stage &stage, const Vector &forces = {});

    /// The bodies of `state` are those at the end of the stage: keep their rates for the stage that
    /// follows. Does nothing if the stage keeps none.
    void
    end(State<dim> &state, const Stage &stage) const;

    /// Add to the report how the stage went and, after the last one, the columns of the bodies and,
    /// to its account if it has one, the work of their loads and the power of their supports.
    /// Collective.
    void
    finish(const State<dim>       &state,
           const Stage            &stage,
           const SolidReport<dim> &solid,
           Report                 &report) const;

    /// Energies, momentum and so on at `time` [s], see solid_columns(); after a step, or at the
    /// start of a run. Collective. @{
    void
    add_columns(Report                 &report,
                const State<dim>       &state,
                double                  time,
                const SolidReport<dim> &solid) const;
    void
    add_columns(Report &report, const State<dim> &state, double time) const;
    /// @}

    const SolidEnvironment<dim> &
    environment() const
    {
      return surroundings;
    }

    const typename SolidModel<dim>::Matrix &
    mass() const
    {
      return solid_stepper.mass();
    }

  private:
    void
    add_work(EnergyAccount          &account,
             const State<dim>       &state,
             const Stage            &stage,
             const SolidReport<dim> &solid) const;
    double
    work_of_kept_rate(const State<dim> &state) const;
    Vector
    expected_velocity(const State<dim> &state, const Stage &stage, const Vector &forces) const;
    void
    start_contact(State<dim> &state, const Stage &stage) const;
    void
    expect_loads(SolidState &solid) const;

    const SolidModel<dim>      &model;
    Budget<dim>                &budget;
    TimingTree                 &timing;
    const SolidEnvironment<dim> surroundings;
    const bool                  is_loaded; ///< by a fluid
    SolidStepper<dim>           solid_stepper;
  };
} // namespace undine

#endif
