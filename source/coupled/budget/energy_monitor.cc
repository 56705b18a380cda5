// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/coupled/budget/energy_monitor.h>
#include <undine/coupled/budget/inertia.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace undine
{
  namespace
  {
    // Of the energy and of what goes in and out.
    constexpr double largest_share = 0.1;

    // Of the largest energy, by all steps together, and of the energy and of what goes in and out
    // by a step that adds to them.
    constexpr double largest_sum = 0.005, share_in_sum = 0.002;

    // Of the largest energy: what may be gained back of what steps have lost. Where vibrations are
    // just resolved, the energy that a step gets wrong is lost and gained in turns.
    constexpr double most_regained = 3 * largest_sum;

    // A step of half the length is worth its time only if it creates less than half as much, and
    // where that is still too much for one step if it is less. After one that is not the next may
    // be.
    constexpr double       half_as_much = 0.4, less = 0.8;
    constexpr unsigned int most_vain = 2;

    // In the first step, of all works.
    constexpr double small_work_of_powers = 1e-3;

    // Speeds at which fluid and bodies move by this share of their extent in a step are rounding.
    constexpr double least_way = 1e-8;


    double
    energy_of(const Columns &columns)
    {
      static const std::array<std::string, 4> names{
        {"Fluid kinetic energy", "solid kinetic energy", "solid elastic energy", "contact energy"}};
      double sum = 0;
      for (const auto &column : columns)
        if (std::find(names.begin(), names.end(), column.name) != names.end())
          sum += column.value;
      return sum;
    }
  } // namespace


  void
  EnergyMonitor::add_options(const Options &options, const Response usual)
  {
    const auto time = options.section("Time"), output = options.section("Output");
    response = usual == Response::none ? "off" : usual == Response::warn ? "warn" : "redo";
    time.add(
      "Energy monitor",
      response,
      "",
      Allowed::one_of({"off", "warn", "redo"}),
      "What to do about a step in which fluid and bodies gain more energy than has been put "
      "into them from outside, by more than a tenth of it and of what goes in and out: "
      "nothing; a warning; or redo it with half its length, as long as that creates less. Smaller "
      "amounts add up, less what was lost before, to a two-hundredth of the largest energy before "
      "that.");
    output.add(
      "Energy account",
      writes_columns,
      "",
      Allowed::anything(),
      "Write the energy of fluid and bodies, what is put into them in every step, and what "
      "all steps have created, as Time / Energy monitor sees it.");
    if (writes_columns && response == "off")
      output.mistake(output.error(
        "Energy account", "needs the monitor", "Try: Time / Energy monitor = warn or redo."));
  }


  /// The row of the account in `statistics`.
  void
  EnergyMonitor::add_columns(Columns             &columns,
                             const EnergyAccount &account,
                             const EnergyInput   &input) const
  {
    if (!writes_columns)
      return;
    const auto add = [&](const std::string &name, const double value) {
      columns.push_back({name, "J", value});
    };
    add("energy", account.energy);
    add("energy put in", input.by_means);
    add("energy put in by forces at the end", input.at_end);
    add("energy exchanged", input.of_works + input.of_powers);
    add("energy created", account.created);
  }


  template <int dim>
  void
  EnergyMonitor::start(const Models<dim> &models, State<dim> &state, Columns &columns)
  {
    if (response == "off")
      return;
    if (writes_columns && models.direction != Direction::two_way)
      throw InputError("Output / Energy account: of a coupling in one direction there is none. "
                       "Try: remove the key.");
    if (models.direction != Direction::two_way)
      return; // what one side gives the other does not get
    auto &account  = state.account.emplace();
    account.energy = account.largest = energy_of(columns);
    add_columns(columns, account, {account, account, 0.});
    moment = inertia(models);
  }


  template <int dim>
  void
  EnergyMonitor::begin_step(State<dim> &state, Report &report) const
  {
    if (response == "off" || !state.account)
      return;
    report.account.emplace();
    state.step_begin = state.solid;
  }


  /// What a step creates.
  struct EnergyMonitor::Creation
  {
    bool   is_known = false;
    double energy   = 0; ///< (B3) [J]
    double share    = 0; ///< of the energy and of what goes in and out, or less with forces at the
                         ///< end of the step [1]
    double uncertain   = 0; ///< how far `energy` may be off: forces are known at both ends only [J]
    bool   exceeds_sum = false; ///< that all steps together may create

    bool
    is_allowed() const
    {
      return !is_known || (share <= largest_share && !exceeds_sum);
    }
  };


  EnergyMonitor::Creation
  EnergyMonitor::created(const EnergyAccount &last, const EnergyAccount &now, const double dt) const
  {
    const EnergyInput input(last, now, dt);
    const double      gain = now.energy - last.energy;
    const double      scale =
      last.energy + input.of_works + input.of_powers + moment * std::pow(least_way / dt, 2);

    Creation step;
    if (std::isnan(last.energy))
      return step;
    step.is_known =
      last.known || input.of_powers <= small_work_of_powers * (scale - input.of_powers);
    step.energy        = gain - input.by_means;
    const double least = std::min(step.energy, gain - input.at_end);
    step.share         = least / scale;
    step.uncertain     = largest_share * input.of_powers + step.energy - least;
    step.exceeds_sum =
      step.share > share_in_sum && last.balance - last.excused + step.energy >
                                     largest_sum * now.largest + last.uncertain + step.uncertain;
    return step;
  }


  /// Throws SolveError if the step is to be redone with a shorter one, NoShorterStep if with a
  /// longer one; else warns.
  void
  EnergyMonitor::respond(const Creation &step, Report &report, const bool can_be_cut) const
  {
    const auto text  = fmt::format("the step creates {:.3g} J, {:.2g} of the energy and of what "
                                   "goes in and out",
                                  step.energy,
                                  step.share);
    auto      &tries = report.creations;
    if (response == "redo" && !tries.are_over)
      {
        const double worthwhile = tries.best_share > largest_share ? less : half_as_much;
        if (tries.number == 0 || step.energy < worthwhile * tries.least_energy)
          {
            tries.least_energy        = step.energy;
            tries.best_share          = step.share;
            tries.best_halvings       = report.halvings;
            tries.best_is_by_fallback = report.is_by_fallback;
            tries.vain                = 0;
          }
        else
          ++tries.vain;
        const bool goes_on =
          can_be_cut && (tries.vain < most_vain || tries.best_share > largest_share);
        tries.are_over = !goes_on;
        if (goes_on || tries.vain > 0)
          ++tries.number;
        if (goes_on)
          throw SolveError(text);
        if (tries.vain > 0)
          throw NoShorterStep(text);
      }
    if (step.share > largest_share)
      report.warn(
        "energy created in a step",
        text + (tries.number > 0 ? ", in shorter ones no less" : "") +
          ". Try: shorter steps, a finer grid, or, where another integrator has been chosen, "
          "trapezoid_bdf2.");
  }


  template <int dim>
  void
  EnergyMonitor::judge(State<dim> &state, Report &report, const bool can_be_cut) const
  {
    state.step_begin = {};
    if (!report.account)
      return; // off, or a coupling in one direction
    const auto &last = *state.account;
    auto       &now  = *report.account;
    now.energy       = energy_of(report.columns);
    now.largest      = std::max(last.largest, now.energy);
    now.known        = true;
    const auto step  = created(last, now, report.dt);
    if (!step.is_allowed())
      respond(step, report, can_be_cut);
    report.share_created = step.is_known ? step.share : 0;
    if (step.is_known)
      {
        now.created   = std::max(0., last.created + step.energy);
        now.balance   = std::max(-most_regained * now.largest, last.balance + step.energy);
        now.excused   = std::min(now.created, last.excused + (step.is_allowed() ? 0 : step.energy));
        now.uncertain = last.uncertain + step.uncertain;
      }
    if (now.created > largest_share * now.largest + now.uncertain)
      report.warn("energy created",
                  fmt::format("steps have created {:.3g} J, {:.2g} of the largest energy so far. "
                              "Try: shorter steps.",
                              now.created,
                              now.created / now.largest));
    add_columns(report.columns, now, {last, now, report.dt});
    state.account = now;
  }


#define INSTANTIATE(dim)                                                            \
  template void EnergyMonitor::start(const Models<dim> &, State<dim> &, Columns &); \
  template void EnergyMonitor::begin_step(State<dim> &, Report &) const;            \
  template void EnergyMonitor::judge(State<dim> &, Report &, bool) const;

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
