// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_margins_h
#define undine_driver_margins_h

#include <undine/coupled/state/report.h>
#include <undine/driver/energy_growth.h>

#include <map>
#include <string>
#include <vector>

namespace undine
{
  /// How well a run keeps what is conserved. Equations (V8) to (V11) of doc/hard_cases.md.
  class Margins
  {
  public:
    /// In that step of the run in which its margin was least.
    struct Margin
    {
      std::string law, meaning;
      double      value = 0, bound = 1; ///< [1]

      /// 1: kept exactly; less than 0: violated.
      double
      margin() const
      {
        return 1 - value / bound;
      }
    };

    void
    observe(const Report &report, const EnergyGrowth::Step &step);

    const std::vector<Margin> &
    all() const
    {
      return margins;
    }

  private:
    /// A probe of a chamber: what has flowed in, and the volume, since the first step.
    struct Chamber
    {
      double first = 0, inflow = 0, rate = 0; ///< [m^dim], [m^dim], [m^dim/s]
    };

    void
    note(const std::string &law, double value, double bound, const std::string &meaning);
    void
    observe_energy(const Report &report, const EnergyGrowth::Step &step);
    void
    observe_chambers(const Report &report);

    std::vector<Margin>            margins;
    std::map<std::string, Chamber> chambers;
    double                         last_energy = -1, largest = 0, created = 0, exchanged = 0; // [J]
  };
} // namespace undine

#endif
