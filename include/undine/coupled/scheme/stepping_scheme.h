// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_scheme_stepping_scheme_h
#define undine_coupled_scheme_stepping_scheme_h

#include <undine/base/core/errors.h>
#include <undine/contact/passage_check.h>
#include <undine/coupled/adaptivity/steadiness.h>
#include <undine/coupled/adaptivity/step_error.h>
#include <undine/coupled/budget/budget.h>
#include <undine/coupled/budget/energy_monitor.h>
#include <undine/coupled/scheme/scheme.h>
#include <undine/coupled/step/physics.h>
#include <undine/solid/time/time_integrator.h>

#include <memory>
#include <string>

namespace undine
{
  /// The choice of the length of steps, which all schemes on grids and finite elements have in
  /// common.
  ///
  /// A step that fails is redone from the saved state with half its length, as long as that is not
  /// below the shortest one, Time/Step halved `Maximum cuts` times. The next step has the length
  /// that went well, and those after it double it up to the length asked for, the later the more
  /// often that failed (StepLimit). The shortest length is a bound of lengths, not of cuts of each
  /// step: short of a time that no step gets past, every accepted step would allow yet shorter
  /// ones. Wrong input fails at once, and so does a body that passes a wall or enters an obstacle
  /// from which no contact keeps it.
  ///
  /// A step that creates energy is redone like one that fails (EnergyMonitor), but accepted, with a
  /// warning, where shorter ones are not better.
  ///
  /// Stages go on with rates, and bodies in a fluid end them where the grid has been cut for them:
  /// for a body that is far lighter than the fluid, shaken within a step, there may be no such end.
  /// Such a step that fails with a quarter of Time/Step, too, is taken by implicit Euler
  /// (Time/Fallback), of first order, which damps what shakes; the next one begins without rates.
  ///
  /// With a tolerance Time/Step is the longest step, and StepError chooses: a step with too large
  /// an error is redone like one that fails, but the shortest one is accepted. What it needs is
  /// part of the state: a resumed run takes the steps that it would have taken.
  template <int dim>
  class SteppingScheme : public Scheme<dim>
  {
  public:
    void
    add_options(const Options &options) override;

    Report
    initialize(State<dim> &state, const Models<dim> &models, TimingTree &timing) override;

    double
    choose_dt(const State<dim> &state) const override;

    Report
    step(State<dim> &state, double asked) override;

  protected:
    /// Has the integrator of the scene stages that keep rates?
    bool
    has_stages() const;

    /// Fluid and bodies together.
    virtual std::unique_ptr<Physics<dim>>
    couple(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing) const = 0;

    /// Does couple() find velocities of bodies and pressures together?
    virtual bool
    solves_together() const
    {
      return false;
    }

    /// To steps that create energy, unless the scene says otherwise.
    virtual EnergyMonitor::Response
    response_to_created_energy() const
    {
      return EnergyMonitor::Response::redo;
    }

    /// What is foretold of the scheme itself; none if it does not split.
    virtual std::optional<double>
    own_growth(const SplittingStability & /*foretold*/) const
    {
      return {};
    }

  private:
    /// The keys of sections `Time` and `Output`. @{
    void
    add_step_options(const Options &time);
    void
    add_steady_options(const Options &time);
    void
    add_output_options(const Options &output);
    /// @}

    /// From `saved`, with another length of the step.
    static void
    start_again(State<dim> &state, const State<dim> &saved, Report &report);
    void
    start_passage_check(const Models<dim> &models);
    void
    check_passages(const State<dim> &saved, const State<dim> &state, double dt) const;
    void
    judge_error(State<dim> &state, const State<dim> &saved, Report &report) const;
    void
    add_error(Report &report, const State<dim> &state) const;
    double
    shortest_step() const;
    double
    first_step() const;
    bool
    may_create_less(const Report &report) const;
    /// Is half the last step of the report long enough?
    bool
    can_be_cut(const Report &report) const;
    /// Does the step from `state` begin by implicit Euler, as the last one did?
    bool
    begins_by_fallback(const State<dim> &state) const;
    /// Has the last step of the report been made by the integrator, and is it short enough for
    /// implicit Euler?
    bool
    can_fall_back(const Report &report) const;
    Stages
    stages(const State<dim> &state, const Report &report) const;
    void
    choose_next_attempt(const State<dim> &state,
                        Report           &report,
                        double            asked,
                        const SolveError &error) const;
    std::string
    complaint(double asked, const Report &last, const SolveError &error) const;

    std::unique_ptr<Physics<dim>>
    make_physics(const Models<dim> &models, TimingTree &timing) const;

    std::unique_ptr<TimeIntegrator> integrator;
    double                          asked_step          = 0.01; // [s]
    double                          tolerance           = 0;    // [1]
    double                          displacement        = 0;    // [m]
    double                          steady_within       = 0;    // [1]
    double                          steady_for          = 0;    // [s]
    unsigned int                    maximum_cuts        = 8;
    std::string                     fallback            = "implicit Euler";
    bool                            falls_back          = false; // where there is something to gain
    bool                            keeps_budget        = false;
    bool                            keeps_impulses      = false;
    bool                            foretells_splitting = false;
    EnergyMonitor                   energy_monitor;
    std::unique_ptr<Budget<dim>>    budget;
    std::unique_ptr<Physics<dim>>   physics;

    std::unique_ptr<Steadiness<dim>>         steadiness;    // nullptr: the run goes on to its end
    std::unique_ptr<const StepError<dim>>    step_error;    // nullptr: constant steps
    std::unique_ptr<const PassageCheck<dim>> passage_check; // nullptr: there is nothing to check
    std::string                              scene_name;
  };
} // namespace undine

#endif
