// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_state_energy_account_h
#define undine_coupled_state_energy_account_h

#include <algorithm>
#include <cmath>
#include <optional>

namespace undine
{
  /// The energy of fluid and bodies at the end of a step, and what is put into them from outside.
  /// EnergyMonitor compares the two. The work of loads, of weight and of a uniform pressure follows
  /// from where bodies were at the begin and are at the end of the step. Of supports, moving walls
  /// and obstacles, of forces on the fluid, and of what flows in and out, the power at the end of
  /// the step is known.
  struct EnergyAccount
  {
    /// A power at the end of the step [W].
    void
    add_power(const double more)
    {
      power += more;
      exchange += std::abs(more);
    }

    /// The same of one that may be far from its mean at the end of a step: what a step creates is
    /// judged with and without it, and it excuses nothing.
    void
    add_doubtful_power(const double more)
    {
      power += more;
      doubtful += more;
    }

    /// The work of a force in the step, and that of the force at the end of it [J].
    void
    add_work(const double more, const double at_end)
    {
      work += more;
      work_at_end += at_end;
      work_exchange += std::max(std::abs(more), std::abs(at_end));
    }

    double energy        = 0; ///< kinetic, elastic and of contact [J]; not a number: not known
    double power         = 0; ///< sum of powers [W]
    double exchange      = 0; ///< sum of their sizes [W]
    double work          = 0; ///< sum of works in the step [J]
    double work_at_end   = 0; ///< the same of forces at the end of the step [J]
    double work_exchange = 0; ///< sum of their sizes [J]
    double largest       = 0; ///< energy so far [J]
    double created       = 0; ///< by all steps since it last was lost again [J]
    double balance       = 0; ///< the same, less than nothing where more was lost than created [J]
    double excused       = 0; ///< of these what shorter steps would not avoid [J]
    double uncertain     = 0; ///< how far `created` may be off, as rules for work go [J]
    bool   known         = false;

    /// The uniform pressure against which bodies take their volume, at the end of the step [Pa].
    std::optional<double> level;

    double doubtful = 0; ///< of `power`; only until the step is judged: in no checkpoint [W]
  };
} // namespace undine

#endif
