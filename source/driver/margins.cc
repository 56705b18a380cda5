// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/margins.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    constexpr double of_energy = 0.1, of_forces = 1e-3, of_flow = 1e-3, of_chamber = 0.01;


    bool
    begins_with(const std::string &text, const std::string &begin)
    {
      return text.compare(0, begin.size(), begin) == 0;
    }
  } // namespace


  void
  Margins::note(const std::string &law,
                const double       value,
                const double       bound,
                const std::string &meaning)
  {
    const Margin now{law, meaning, std::abs(value), bound};
    for (auto &least : margins)
      if (least.law == law)
        {
          // What is not a number is worse than any.
          if (!(now.margin() >= least.margin()) && !std::isnan(least.margin()))
            least = now;
          return;
        }
    margins.push_back(now);
  }


  void
  Margins::observe(const Report &report, const EnergyGrowth::Step &step)
  {
    observe_energy(report, step);
    for (const auto &column : report.columns)
      if (begins_with(column.name, "momentum residual "))
        note("momentum of body " + column.name.substr(18),
             column.value,
             of_forces,
             "forces and inertia of a body in sum, of the sizes of all forces");
      else if (column.name == "Fluid divergence")
        note("volume of the fluid",
             column.value,
             of_flow,
             "|div v| dx in a cell, of the fluid's largest speed");
    observe_chambers(report);
  }


  /// (V8)
  void
  Margins::observe_energy(const Report &report, const EnergyGrowth::Step &step)
  {
    double uncertain = of_energy * exchanged;
    if (report.account)
      {
        created   = report.account->created;
        largest   = report.account->largest;
        uncertain = report.account->uncertain;
      }
    else if (step.input_known)
      {
        if (last_energy >= 0)
          {
            created = std::max(0., created + step.energy - last_energy - step.input);
            exchanged += step.exchange;
          }
        largest     = std::max(largest, step.energy);
        last_energy = step.energy;
        uncertain   = of_energy * exchanged;
      }
    else
      return;
    if (largest > step.least)
      note("energy",
           created / largest,
           of_energy + uncertain / largest,
           "created by all steps and not lost again, of the largest energy so far");
  }


  /// (V11): any pair of columns "X volume", "X inflow".
  void
  Margins::observe_chambers(const Report &report)
  {
    for (std::size_t k = 1; k < report.columns.size(); ++k)
      {
        const auto       &volume = report.columns[k - 1], &inflow = report.columns[k];
        const std::size_t length =
          volume.name.size() - std::min<std::size_t>(7, volume.name.size());
        if (volume.name.substr(length) != " volume" ||
            inflow.name != volume.name.substr(0, length) + " inflow")
          continue;
        auto [place, is_new] = chambers.try_emplace(inflow.name);
        auto &chamber        = place->second;
        if (is_new)
          chamber.first = volume.value;
        else
          chamber.inflow += report.dt / 2 * (chamber.rate + inflow.value);
        chamber.rate = inflow.value;
        if (chamber.first > 0)
          note("volume of " + volume.name.substr(0, length),
               (volume.value - chamber.first - chamber.inflow) / chamber.first,
               of_chamber,
               "volume less what has flowed in, of the volume at first");
      }
  }
} // namespace undine
