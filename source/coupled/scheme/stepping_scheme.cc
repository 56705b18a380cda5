// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/adaptivity/sleeping_bodies.h>
#include <undine/coupled/scheme/stepping_scheme.h>
#include <undine/coupled/stability/linear_stability.h>
#include <undine/coupled/step/fluid_alone.h>
#include <undine/coupled/step/one_way.h>
#include <undine/coupled/step/solid_alone.h>
#include <undine/fluid/grid/field_algebra.h>

#include <fmt/format.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// Those that stages have kept: what fails with them is not to be advected.
    template <int dim>
    void
    forget_rates(FluidState<dim> &state)
    {
      scale(state.acceleration, 0.);
      scale(state.change, 0.);
    }
  } // namespace


  template <int dim>
  void
  SteppingScheme<dim>::add_options(const Options &options)
  {
    const auto time = options.section("Time");
    add_step_options(time);
    add_steady_options(time);
    energy_monitor.add_options(options, response_to_created_energy());
    integrator = choose_time_integrator(options);
    add_output_options(options.section("Output"));
  }


  template <int dim>
  void
  SteppingScheme<dim>::add_step_options(const Options &time)
  {
    time.require("Step",
                 asked_step,
                 "s",
                 Allowed::positive(),
                 "Length of a time step; with a Tolerance that of the longest.");
    time.add(
      "Tolerance",
      tolerance,
      "1",
      Allowed::below(0, 1),
      "Steps are chosen so that their errors in time add up to this by the end of the run, "
      "relative to the largest displacement of the bodies so far, or to the largest velocity "
      "of a fluid without bodies (root mean squares). 0: all steps are of length Step.");
    time.add("Least displacement",
             displacement,
             "m",
             Allowed::not_negative(),
             "What the Tolerance is relative to as long as the bodies have moved less (root mean "
             "square). 0: a thousandth of their extent.");
    time.add("Maximum cuts",
             maximum_cuts,
             "",
             Allowed::between(0, 20),
             "A step that fails is redone with half its length; the run stops where that would be "
             "less than Step halved so often.");
    time.add(
      "Fallback",
      fallback,
      "",
      Allowed::one_of({"implicit Euler", "none"}),
      "What takes a step of bodies in a fluid that fails with a quarter of Step, too, or "
      "creates energy, if the integrator has stages and both are solved together in steps of "
      "a given length, of which Maximum cuts allows a quarter: implicit Euler is of first "
      "order and damps what shakes. Steps that it takes are counted. none: such steps are cut "
      "further.");
  }


  template <int dim>
  void
  SteppingScheme<dim>::add_steady_options(const Options &time)
  {
    time.add(
      "Steady within",
      steady_within,
      "1",
      Allowed::below(0, 1),
      "The run ends before End once neither the fluid's velocity nor the bodies' displacement "
      "(root mean squares), nor the forces of the fluid on bodies and obstacles, have changed by "
      "more than this part for the time Steady for. 0: it goes on to End.");
    time.add("Steady for",
             steady_for,
             "s",
             Allowed::not_negative(),
             "With Steady within: as long as what has to settle takes for that, such as a time "
             "constant or a period. A run that is resumed begins to count anew.");
    if (steady_within > 0 && steady_for == 0)
      time.mistake(
        time.error("Steady for",
                   "'Steady within' needs it",
                   "Give the time in which what has to settle comes closer to its end."));
  }


  template <int dim>
  void
  SteppingScheme<dim>::add_output_options(const Options &output)
  {
    output.add(
      "Budget",
      keeps_budget,
      "",
      Allowed::anything(),
      "Write what energy and momentum of every step come from and go to, and what the sums lack.");
    output.add(
      "Impulses",
      keeps_impulses,
      "",
      Allowed::anything(),
      "Write what the fluid's forces on every body and obstacle have added up to since the "
      "start of the run, 'pressure impulse NAME x' and 'viscous impulse NAME x' [N s], as "
      "the integrator adds them up. The rate of an impulse is a mean force, with fewer "
      "spikes than the force at the end of a step where surfaces cross cells.");
    output.add(
      "Stability of splitting",
      foretells_splitting,
      "",
      Allowed::anything(),
      "At the start of the run, whatever its scheme: would time splitting be stable with this "
      "step? By the eigenvalues of a linearised step, in the log and in summary.json. For the "
      "integrators theta and newmark.");
  }


  template <int dim>
  bool
  SteppingScheme<dim>::has_stages() const
  {
    return integrator->stages(1, RatesAtBegin::known).size() > 1;
  }


  template <int dim>
  Report
  SteppingScheme<dim>::initialize(State<dim> &state, const Models<dim> &models, TimingTree &timing)
  {
    budget = std::make_unique<Budget<dim>>(models, keeps_budget ? KeepBudget::yes : KeepBudget::no);
    if (models.solid && models.requests_of_effects().sleep_settings)
      physics = std::make_unique<SleepingBodies<dim>>(
        models,
        *budget,
        timing,
        [this, &timing](const Models<dim> &awake) { return make_physics(awake, timing); },
        [this](const double dt) { return integrator->stages(dt, RatesAtBegin::unknown); });
    else
      physics = make_physics(models, timing);

    start_passage_check(models);
    falls_back = fallback != "none" && has_stages() && tolerance == 0 && models.solid &&
                 models.fluid && models.direction == Direction::two_way && solves_together();

    Report report;
    if (tolerance > 0)
      step_error = std::make_unique<const StepError<dim>>(
        models,
        *integrator,
        typename StepError<dim>::Settings{
          tolerance, displacement, asked_step, shortest_step(), first_step()});
    if (steady_within > 0)
      steadiness = std::make_unique<Steadiness<dim>>(models, steady_within, steady_for);
    if (keeps_impulses && !(models.fluid && models.surface))
      throw InputError(
        "'Output / Impulses' are those of bodies and obstacles in a fluid, which the "
        "scene does not have. Try: remove the key.");
    if (keeps_impulses)
      {
        const unsigned int n = models.surface->surface().body_names().size();
        state.impulses       = {Impulse<dim>(n), Impulse<dim>(models.has_friction() ? n : 0)};
      }
    physics->initialize(state, choose_dt(state), report);
    if (foretells_splitting)
      {
        const auto timed                = timing.section("stability of splitting");
        report.splitting                = splitting_stability(models, state, asked_step);
        report.splitting->growth_of_run = own_growth(*report.splitting);
      }
    state.budget_rates = budget->rates_at_start();
    append(report.columns, budget->columns());
    energy_monitor.start(models, state, report.columns);
    if (step_error)
      {
        step_error->start(state);
        add_error(report, state);
      }
    return report;
  }


  template <int dim>
  std::unique_ptr<Physics<dim>>
  SteppingScheme<dim>::make_physics(const Models<dim> &models, TimingTree &timing) const
  {
    if (!models.solid)
      return std::make_unique<FluidAlone<dim>>(models, *budget, timing);
    if (!models.fluid)
      return std::make_unique<SolidAlone<dim>>(models, *budget, timing);
    if (models.direction != Direction::two_way)
      return std::make_unique<OneWay<dim>>(models, *budget, timing);
    return couple(models, *budget, timing);
  }


  template <int dim>
  double
  SteppingScheme<dim>::choose_dt(const State<dim> &state) const
  {
    if (step_error)
      return state.clock.land(state.history.in_use() ? state.history.step : first_step());
    return state.clock.land(std::min(asked_step, state.clock.limit.longest));
  }


  template <int dim>
  Report
  SteppingScheme<dim>::step(State<dim> &state, const double asked)
  {
    if (step_error && !state.history.in_use())
      step_error->start(state); // resumed from a run of constant steps
    const State<dim> saved = state;
    std::string      cause; // of the last cut
    Report           report;
    // What is hard is so for a while: as long as steps are shorter than asked for.
    report.is_by_fallback = begins_by_fallback(state);
    for (;; ++report.cuts)
      try
        {
          report.dt = asked / (1u << report.halvings);
          energy_monitor.begin_step(state, report);
          budget->start(state.budget_rates);
          if (report.is_by_fallback)
            forget_rates(state.fluid);
          physics->advance(state, stages(state, report), report);
          append(report.columns, budget->columns());
          state.budget_rates = budget->rates();
          assert_finite(report.columns);
          energy_monitor.judge(state, report, may_create_less(report));
          judge_error(state, saved, report);
          check_passages(saved, state, report.dt);
          if (steadiness)
            report.steady =
              steadiness->observe(state, report.columns, state.clock.time + report.dt);
          if (report.halvings > 0 || (report.is_by_fallback && report.cuts > 0))
            state.clock.limit.accept_cut(report.dt);
          else
            state.clock.limit.accept(report.dt);
          state.clock.after_fallback = report.is_by_fallback;
          report.warn("step cuts", cause);
          return report;
        }
      catch (const EnergyMonitor::NoShorterStep &)
        {
          start_again(state, saved, report);
          report.halvings       = report.creations.best_halvings;
          report.is_by_fallback = report.creations.best_is_by_fallback;
          if (report.halvings == 0 && !report.is_by_fallback)
            cause.clear();
        }
      catch (const SolveError &error)
        {
          start_again(state, saved, report);
          const bool was_by_fallback = report.is_by_fallback;
          choose_next_attempt(saved, report, asked, error);
          if (report.rejections < report.cuts + 1)
            cause = fmt::format(
              "a step of {:.4g} s was {}: {}",
              report.dt,
              report.is_by_fallback && !was_by_fallback ? "taken by implicit Euler" : "cut",
              error.what());
        }
      catch (const Error &)
        {
          state = saved;
          throw;
        }
  }


  template <int dim>
  Stages
  SteppingScheme<dim>::stages(const State<dim> &state, const Report &report) const
  {
    if (report.is_by_fallback)
      return {single_stage(report.dt)};
    // Rates of bodies in contact contain its forces on both of them: they hold no longer where one
    // has fallen asleep.
    const bool are_known =
      state.clock.step > 0 && !state.clock.after_fallback && !state.sleep.begins_anew;
    return integrator->stages(report.dt, are_known ? RatesAtBegin::known : RatesAtBegin::unknown);
  }


  /// After one that has failed with `error`, which is thrown, said in full, if there is none.
  template <int dim>
  void
  SteppingScheme<dim>::choose_next_attempt(const State<dim> &state,
                                           Report           &report,
                                           const double      asked,
                                           const SolveError &error) const
  {
    if (can_fall_back(report))
      report.is_by_fallback = true;
    else if (can_be_cut(report))
      {
        // What implicit Euler cannot follow either, stages may in half the time, unless they have
        // failed since the steps before.
        ++report.halvings;
        report.is_by_fallback = report.is_by_fallback && begins_by_fallback(state);
      }
    else if (report.creations.end())
      {
        report.halvings       = report.creations.best_halvings;
        report.is_by_fallback = report.creations.best_is_by_fallback;
      }
    else if (report.is_by_fallback && begins_by_fallback(state))
      {
        report.tries_stages   = true; // at last
        report.halvings       = 0;
        report.is_by_fallback = false;
      }
    else
      throw SolveError(complaint(asked, report, error));
  }


  template <int dim>
  void
  SteppingScheme<dim>::start_again(State<dim> &state, const State<dim> &saved, Report &report)
  {
    state                    = saved;
    report.newton_iterations = report.linear_iterations = 0;
    report.columns.clear();
    report.warnings.clear();
  }


  template <int dim>
  void
  SteppingScheme<dim>::start_passage_check(const Models<dim> &models)
  {
    if (!models.solid || !models.fluid)
      return;
    const auto                        contact = models.requests_of_effects().contact_settings;
    typename PassageCheck<dim>::Scope scope;
    scope.contact   = contact.has_value();
    scope.sides     = !contact || contact->at_domain;
    scope.obstacles = !contact;
    scene_name      = models.surface->scene_name();
    if (scope.sides || scope.obstacles)
      passage_check = std::make_unique<const PassageCheck<dim>>(
        *models.solid, *models.fluid, &models.surface->obstacles(), scope);
  }


  /// Throws InputError if a body has passed a wall in the step, or entered an obstacle.
  template <int dim>
  void
  SteppingScheme<dim>::check_passages(const State<dim> &saved,
                                      const State<dim> &state,
                                      const double      dt) const
  {
    if (!passage_check)
      return;
    const double      end = saved.clock.time + dt;
    const std::string complaint =
      passage_check->complaint(saved.solid.displacement, state.solid.displacement, end);
    if (!complaint.empty())
      throw InputError(fmt::format("{}: by {:.6g} s {}", scene_name, end, complaint));
  }


  /// Throws SolveError if the error in time of the step from `saved` to `state` is too large;
  /// otherwise the choice of the next step learns of it. Nothing with constant steps.
  template <int dim>
  void
  SteppingScheme<dim>::judge_error(State<dim> &state, const State<dim> &saved, Report &report) const
  {
    if (!step_error)
      return;
    if (can_be_cut(report) && step_error->is_too_large(saved, state, report.dt))
      {
        ++report.rejections;
        throw SolveError("its error in time is too large");
      }
    step_error->accept(state, saved, report);
    add_error(report, state);
  }


  template <int dim>
  void
  SteppingScheme<dim>::add_error(Report &report, const State<dim> &state) const
  {
    report.error_in_time = step_error->error(state.history);
    append(report.columns,
           {{"Error in time", "1", *report.error_in_time},
            {"Rejected steps", "1", double(report.rejections)}});
    if (step_error->is_missed(state.history))
      report.warn(
        "error in time",
        fmt::format("errors in time add up to more than Time/Tolerance = {:.4g}. It takes "
                    "shorter steps than {:.4g} s: try more Time/Maximum cuts.",
                    tolerance,
                    shortest_step()));
  }


  template <int dim>
  bool
  SteppingScheme<dim>::can_be_cut(const Report &report) const
  {
    return report.dt / 2 >= shortest_step() * (1 - 1e-9);
  }


  template <int dim>
  bool
  SteppingScheme<dim>::begins_by_fallback(const State<dim> &state) const
  {
    return falls_back && state.clock.after_fallback &&
           state.clock.limit.longest < asked_step * (1 - 1e-9);
  }


  template <int dim>
  bool
  SteppingScheme<dim>::can_fall_back(const Report &report) const
  {
    constexpr double part = .25; // of the step asked for
    const auto is_short   = [&](const double dt) { return dt <= part * asked_step * (1 + 1e-9); };
    return falls_back && !report.is_by_fallback && !report.tries_stages && is_short(report.dt) &&
           is_short(shortest_step());
  }


  /// Is another attempt at a step that creates energy worth its time?
  template <int dim>
  bool
  SteppingScheme<dim>::may_create_less(const Report &report) const
  {
    constexpr unsigned int most_halvings = 6;
    return can_fall_back(report) || (can_be_cut(report) && report.halvings < most_halvings);
  }


  template <int dim>
  double
  SteppingScheme<dim>::shortest_step() const
  {
    return asked_step / (1u << maximum_cuts);
  }


  /// Of a run whose steps are chosen: short, and one that can be cut.
  template <int dim>
  double
  SteppingScheme<dim>::first_step() const
  {
    constexpr unsigned int spare_cuts = 2;
    return asked_step / (1u << (std::max(maximum_cuts, spare_cuts) - spare_cuts));
  }


  template <int dim>
  std::string
  SteppingScheme<dim>::complaint(const double      asked,
                                 const Report     &last,
                                 const SolveError &error) const
  {
    const std::string shorter =
      last.cuts == 0 ? "" : fmt::format(" and {} more attempt(s) at it", last.cuts);
    return fmt::format("a step of {:.4g} s{} failed, the last one of {:.4g} s: {}\nTime/Step = "
                       "{:.4g} and Time/Maximum cuts = {} allow none shorter than {:.4g} s. If "
                       "steps became shorter and shorter on the way here ('Step cuts' in the "
                       "statistics), still shorter ones will not do: try what else is said above, "
                       "or a longer Time/Step with Maximum cuts = 0. If they did not, try more "
                       "cuts.",
                       asked,
                       shorter,
                       last.dt,
                       error.what(),
                       asked_step,
                       maximum_cuts,
                       shortest_step());
  }


  template class SteppingScheme<2>;
  template class SteppingScheme<3>;
} // namespace undine
