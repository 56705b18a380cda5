// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/coupled/budget/energy_monitor.h>
#include <undine/solid/step/solid_columns.h>

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

    // A shorter step is worth its time only if its share is less by this.
    constexpr double worthwhile = 0.8;

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


    /// (B3).
    double
    created_energy(const EnergyAccount &last, const EnergyAccount &now, const double dt)
    {
      return now.energy - last.energy - dt / 2 * (last.power + now.power);
    }
  } // namespace


  void
  EnergyMonitor::add_options(const Options &time, const Response usual)
  {
    response = usual == Response::none ? "off" : usual == Response::warn ? "warn" : "redo";
    time.add("Energy monitor",
             response,
             "",
             Allowed::one_of({"off", "warn", "redo"}),
             "What to do about a step in which fluid and bodies gain more energy than has been put "
             "into them from outside, by more than a tenth of it and of what goes in and out: "
             "nothing; a warning; or redo it with half its length, as long as that creates less.");
  }


  template <int dim>
  void
  EnergyMonitor::start(const Models<dim> &models, State<dim> &state, const Columns &columns)
  {
    if (response == "off")
      return;
    auto &account  = state.account.emplace();
    account.energy = account.largest = energy_of(columns);
    const auto add                   = [this](const double mass, const double volume) {
      inertia += mass * std::pow(volume, 2. / dim);
    };
    if (models.fluid)
      {
        const auto extent = models.fluid->grid().upper() - models.fluid->grid().lower();
        double     volume = 1;
        for (unsigned int axis = 0; axis < dim; ++axis)
          volume *= extent[axis];
        add(models.fluid->density() * volume, volume);
      }
    if (models.solid)
      for (const auto &body : measure_bodies(*models.solid, models.solid->vector()))
        add(body.mass, body.volume);
  }


  void
  EnergyMonitor::begin_step(Report &report) const
  {
    if (response != "off")
      report.account.emplace();
  }


  double
  EnergyMonitor::scale(const EnergyAccount &last, const EnergyAccount &now, const double dt) const
  {
    return last.energy + dt / 2 * (last.exchange + now.exchange) +
           inertia * std::pow(least_way / dt, 2);
  }


  void
  EnergyMonitor::judge(std::optional<EnergyAccount> &account,
                       Report                       &report,
                       const bool                    can_be_cut) const
  {
    if (!report.account)
      return; // off, or a coupling in one direction, which keeps no energy
    const auto &last = *account;
    auto       &now  = *report.account;
    now.energy       = energy_of(report.columns);
    now.largest      = std::max(last.largest, now.energy);
    now.known        = true;
    if (last.known)
      {
        const double created = created_energy(last, now, report.dt);
        const double share   = created / scale(last, now, report.dt);
        const double earlier = std::exchange(report.created_share, share);
        const auto text = fmt::format("the step creates {:.3g} J, {:.2g} of the energy and of what "
                                      "goes in and out",
                                      created,
                                      share);
        // Where a power rises within a few steps, forces that act at their end do more work.
        const double by_end =
          (now.energy - last.energy - report.dt * now.power) / scale(last, now, report.dt);
        if (std::min(share, by_end) > largest_share)
          {
            const bool helps = earlier <= largest_share || share < worthwhile * earlier;
            if (response == "redo" && can_be_cut && helps)
              {
                ++report.creations;
                throw SolveError(text);
              }
            report.warn("energy created in a step",
                        text +
                          (earlier > largest_share
                             ? fmt::format(", as one twice as long ({:.2g})", earlier)
                             : "") +
                          ". Try: shorter steps, a finer grid, or the integrator trapezoid_bdf2.");
          }
        now.created = std::max(0., last.created + created);
        if (now.created > largest_share * now.largest)
          report.warn(
            "energy created",
            fmt::format("steps have created {:.3g} J, {:.2g} of the largest energy so far. "
                        "Try: shorter steps.",
                        now.created,
                        now.created / now.largest));
      }
    account = now;
  }


  template void
  EnergyMonitor::start(const Models<2> &, State<2> &, const Columns &);
  template void
  EnergyMonitor::start(const Models<3> &, State<3> &, const Columns &);
} // namespace undine
