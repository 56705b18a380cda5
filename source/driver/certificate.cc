// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/certificate.h>
#include <undine/driver/json_text.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    constexpr unsigned int longest_window    = 100;
    constexpr double       least_way         = 1e-7; // of the extent, in a step: less is rounding
    constexpr double       part_of_potential = 1e-3; // less than this is rounding of particles
    constexpr double       rounding          = 1e-6; // of the largest force or velocity
    constexpr double       many_redone       = 0.01; // of all steps
    constexpr unsigned int fewest_steps      = 6;    // of the shortest window of (V2)

    // Of the energy that grows: then they are what shakes the fluid, which often has most of it.
    constexpr double share_of_bodies = 0.1;


    double
    sum(const Columns &columns, const std::vector<std::size_t> &which)
    {
      double result = 0;
      for (const auto k : which)
        result += columns[k].value;
      return result;
    }


    /// The name after `begin`, without the axis at its end; nothing if this is no first component.
    std::optional<std::string>
    name_after(const std::string &column, const std::string &begin)
    {
      const bool is_first = column.size() > begin.size() + 2 &&
                            column.compare(0, begin.size(), begin) == 0 &&
                            column.substr(column.size() - 2) == " x";
      if (!is_first)
        return {};
      return column.substr(begin.size(), column.size() - begin.size() - 2);
    }


    /// Has the growth ended well before `time` [s]?
    bool
    is_over(const Growth &growth, const double time)
    {
      return time - growth.until > 0.1 * (time - growth.since);
    }


    void
    add_recent(std::deque<double> &recent, const double value)
    {
      recent.push_back(value);
      if (recent.size() > longest_window + 1)
        recent.pop_front();
    }
  } // namespace


  /// Names and order of columns are the same in all steps. What swings from frame to frame, of many
  /// steps each, may be any motion, which nobody watches.
  void
  Certificate::find_columns(const Columns &columns)
  {
    const auto has = [&](const std::string &name) {
      return std::any_of(
        columns.begin(), columns.end(), [&](const auto &column) { return column.name == name; });
    };
    for (std::size_t k = 0; k < columns.size(); ++k)
      {
        const auto &name = columns[k].name;
        if (name == "Fluid kinetic energy" || name == "Kinetic energy of fluid")
          energy_of_fluid.push_back(k);
        else if (name == "solid kinetic energy" || name == "solid elastic energy" ||
                 name == "contact energy" || name == "Kinetic energy of bodies" ||
                 name == "Elastic energy")
          energy_of_bodies.push_back(k);
        else if (name == "solid load potential" || name == "Potential energy")
          potential.push_back(k);
        else if (name == "Fluid particles")
          particles = k;
        unsigned int n = 1;
        for (const char axis : {'y', 'z'})
          if (k + n < columns.size() &&
              columns[k + n].name == name.substr(0, name.size() - 1) + axis)
            ++n;
        const auto watch_it = [&](const std::string &where, const bool is_body) -> Watched & {
          auto &added      = watched.emplace_back();
          added.where      = (is_body ? "body " : "fluid") + where;
          added.column     = k;
          added.components = n;
          added.is_body    = is_body;
          return added;
        };
        if (scope.steps_are_frames)
          continue;
        if (const auto body = name_after(name, "centre of mass "))
          watch_it(*body, true).moves = true;
        else if (const auto body = name_after(name, "pressure force "))
          has("max speed " + *body) ? watch_it(*body, true) : watch_it(" at " + *body, false);
        else if (name_after(name, "Pressure force on "))
          watch_it("", false);
      }
  }


  /// The energy of the step's end and what was put in: by the account that EnergyMonitor keeps,
  /// else by weight alone, of which only a closed scene knows that it is all.
  EnergyGrowth::Step
  Certificate::energies(const double time, const Report &report)
  {
    EnergyGrowth::Step step;
    step.time   = time;
    step.energy = sum(report.columns, energy_of_fluid) + sum(report.columns, energy_of_bodies);
    step.least  = scope.inertia * std::pow(least_way / report.dt, 2);
    const double potential = sum(report.columns, this->potential);
    if (report.account && report.account->known)
      {
        const EnergyInput input(last_account.value_or(EnergyAccount()), *report.account, report.dt);
        step.energy       = report.account->energy;
        step.input        = input.by_means;
        step.input_at_end = input.at_end;
        step.exchange     = input.of_works + input.of_powers;
        last_account      = report.account;
      }
    else
      {
        step.input_known = scope.is_closed;
        step.input = step.input_at_end = n_steps > 1 ? last_potential - potential : 0;
        step.exchange                  = std::abs(step.input);
        largest_potential              = std::max(largest_potential, std::abs(potential));
        if (scope.is_closed)
          step.least += part_of_potential * largest_potential;
        else if (particles) // what flows in brings energy: that of one particle in the mean
          for (double *const sum : {&step.energy, &step.input, &step.input_at_end, &step.exchange})
            *sum /= std::max(1., report.columns[*particles].value);
      }
    last_potential = potential;
    return step;
  }


  void
  Certificate::observe(const double time, const Report &report)
  {
    ++n_steps;
    n_redone += report.cuts > 0;
    n_by_fallback += report.is_by_fallback;
    if (n_steps == 1)
      find_columns(report.columns);
    const auto step = energies(time, report);
    add_recent(of_fluid, sum(report.columns, energy_of_fluid));
    add_recent(of_bodies, sum(report.columns, energy_of_bodies));
    watch(time, step.energy, report);
    margins.observe(report, step);
    energy.observe(step);
    locate_growth_of_energy();
  }


  /// A force or a velocity at the end of a step; nothing of a place whose velocity is not known
  /// yet.
  std::optional<Swing::Signal>
  Certificate::signal_of(Watched &each, const Report &report) const
  {
    Swing::Signal signal{};
    for (unsigned int axis = 0; axis < each.components; ++axis)
      signal[axis] = report.columns[each.column + axis].value;
    if (!each.moves)
      return signal;
    const auto place = each.place;
    each.place       = signal;
    if (n_steps == 1)
      return {};
    for (unsigned int axis = 0; axis < each.components; ++axis)
      signal[axis] = (signal[axis] - place[axis]) / report.dt;
    return signal;
  }


  /// What is rounding beside other forces or velocities, or beside the force that takes the energy
  /// away over the extent of the domain, may do as it likes.
  void
  Certificate::watch(const double time, const double energy, const Report &report)
  {
    if (scope.extent > 0)
      largest_force = std::max(largest_force, energy / scope.extent);
    std::vector<std::optional<Swing::Signal>> signals;
    for (auto &each : watched)
      {
        signals.push_back(signal_of(each, report));
        if (const auto &signal = signals.back())
          for (const double component : *signal)
            {
              double &largest = each.moves ? largest_velocity : largest_force;
              largest         = std::max(largest, std::abs(component));
            }
      }
    for (std::size_t k = 0; k < watched.size(); ++k)
      if (signals[k])
        watched[k].swing.observe(time,
                                 report.dt,
                                 *signals[k],
                                 rounding * (watched[k].moves ? largest_velocity : largest_force));
  }


  /// Whose energy grows most, in which way.
  void
  Certificate::locate_growth_of_energy()
  {
    if (!energy.growth() && !energy.unexplained())
      located_over = 0;
    const unsigned int window = energy.steps_of_growth();
    if (window <= located_over)
      return;
    located_over    = window; // the longer, the clearer
    const auto gain = [&](const std::deque<double> &energies) {
      return energies.back() - energies[energies.size() - 1 - window];
    };
    const double   of_all    = gain(of_bodies) + gain(of_fluid);
    const bool     in_bodies = gain(of_bodies) > share_of_bodies * of_all;
    const Watched *most      = nullptr;
    for (const auto &each : watched)
      if (each.moves == in_bodies &&
          (most == nullptr || each.swing.gain(window) > most->swing.gain(window)))
        most = &each;
    where = !in_bodies ? "fluid" : most != nullptr ? most->where : "bodies";
    mode  = most != nullptr ? most->swing.mode(window) : "monotonic";
  }


  /// What has grown first, of bodies if there is one that does: it is they that shake the fluid.
  /// The energy where nothing swings more and more.
  std::optional<Growth>
  Certificate::growth() const
  {
    std::optional<Growth> first;
    bool                  is_body = false;
    for (const auto &each : watched)
      if (const auto &of_this = each.swing.growth())
        if (!first || each.is_body > is_body ||
            (each.is_body == is_body && of_this->since < first->since))
          {
            first        = of_this;
            first->where = each.where;
            is_body      = each.is_body;
          }
    if (first || !energy.growth())
      return first;
    first        = energy.growth();
    first->where = where;
    first->mode  = mode;
    return first;
  }


  /// Of what nobody can tell: the energy, or something that swings.
  std::optional<Growth>
  Certificate::apparent_growth() const
  {
    std::optional<Growth> result = energy.unexplained();
    if (result)
      {
        result->where = where;
        result->mode  = mode;
        result->doubt = "whether it was put in is not known";
        return result;
      }
    for (const auto &each : watched)
      if (const auto &of_this = each.swing.apparent_growth())
        if (!result || of_this->since < result->since)
          {
            result        = of_this;
            result->where = each.where;
            result->doubt =
              "samples of a steady swing with a period next to two steps may look like this";
          }
    return result;
  }


  /// Something that has grown and died away.
  std::optional<Growth>
  Certificate::past() const
  {
    std::optional<Growth> last = energy.past();
    if (last)
      last->where = "energy";
    for (const auto &each : watched)
      if (each.swing.past() && (!last || each.swing.past()->until > last->until))
        {
          last        = each.swing.past();
          last->where = each.where;
        }
    return last;
  }


  std::string
  Certificate::verdict(const std::string &failure) const
  {
    if (!failure.empty())
      return "failed";
    if (growth())
      return "growing";
    const bool is_undecided = n_steps == 0 || apparent_growth() || is_too_short_to_tell();
    return is_undecided ? "undecided" : "stable";
  }


  /// Has a law been broken in fewer steps than rules of growth need?
  bool
  Certificate::is_too_short_to_tell() const
  {
    return n_steps < fewest_steps && !violated().empty();
  }


  std::string
  Certificate::violated() const
  {
    std::string result;
    for (const auto &law : margins.all())
      if (!(law.margin() >= 0))
        result += (result.empty() ? "; not kept: " : ", ") + law.law;
    return result;
  }


  std::string
  Certificate::redone() const
  {
    std::string result;
    if (n_redone > many_redone * n_steps)
      result = fmt::format(
        "; {} of {} steps were redone ({:.2g} %)", n_redone, n_steps, 100. * n_redone / n_steps);
    if (n_by_fallback > 0)
      result += fmt::format(
        "; {} of {} steps were taken by implicit Euler, of first order", n_by_fallback, n_steps);
    return result;
  }


  std::string
  Certificate::text(const double time, const std::string &failure) const
  {
    const auto        now = growth();
    const std::string growing =
      now ? fmt::format("growing since t = {:.6g} s: {}{}",
                        now->since,
                        now->text(),
                        is_over(*now, time) ? fmt::format(", until {:.6g} s", now->until) : "")
          : "";
    if (!failure.empty())
      return fmt::format("failed at t = {:.6g} s: {}{}",
                         time,
                         failure,
                         (now ? "; " : "") + growing + violated() + redone());
    if (now)
      return growing + violated() + redone();
    if (const auto apparent = apparent_growth())
      return fmt::format("undecided, it seems to grow from {:.6g} to {:.6g} s: {}; {}{}",
                         apparent->since,
                         apparent->until,
                         apparent->text(),
                         apparent->doubt,
                         redone());
    if (n_steps == 0)
      return "undecided: no step has been made";
    if (is_too_short_to_tell())
      return fmt::format(
        "undecided: {} step(s) are too few to see what grows{}", n_steps, violated());
    std::string died_away;
    if (const auto gone = past())
      died_away = fmt::format("; what grew from {:.6g} to {:.6g} s ({}) has died away",
                              gone->since,
                              gone->until,
                              gone->where);
    return "stable" + died_away + violated() + redone();
  }


  void
  Certificate::print(Log &log, const double time, const std::string &failure) const
  {
    if (!failure.empty())
      {
        if (growth())
          log.print("\nWARNING: before it failed, the run was {}", text(time, ""));
        return;
      }
    const bool is_bad = verdict("") == "growing" || !violated().empty();
    log.print("\n{}: {}", is_bad ? "WARNING" : "verdict", text(time, ""));
    for (const auto &law : margins.all())
      log.print("  {:<28} margin {:>7.4f}  {:.1e} of {:.1e}: {}",
                law.law,
                law.margin(),
                law.value,
                law.bound,
                law.meaning);
  }


  std::string
  Certificate::json(const double time, const std::string &failure) const
  {
    std::string grows;
    if (const auto now = growth())
      grows = fmt::format(",\n    \"since [s]\": {:.10g}, \"until [s]\": {:.10g}, \"where\": {}, "
                          "\"mode\": {}, \"grows\": {}, \"factor per step\": {}",
                          now->since,
                          now->until,
                          quoted(now->where),
                          quoted(now->mode),
                          quoted(now->what),
                          json_number(now->factor));
    return fmt::format(
      "{{\n    \"verdict\": {},\n    \"text\": {},\n    \"steps\": {}, \"steps redone\": {}, "
      "\"steps by fallback\": {}{},\n"
      "    \"margins\": {}\n  }}",
      quoted(verdict(failure)),
      quoted(text(time, failure)),
      n_steps,
      n_redone,
      n_by_fallback,
      grows,
      json_list(margins.all(), [](const auto &law) {
        return fmt::format(
          "  {{\"law\": {}, \"value\": {}, \"bound\": {}, \"margin\": {}, \"meaning\": {}}}",
          quoted(law.law),
          json_number(law.value),
          json_number(law.bound),
          json_number(law.margin()),
          quoted(law.meaning));
      }));
  }
} // namespace undine
