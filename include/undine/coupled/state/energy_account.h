// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_state_energy_account_h
#define undine_coupled_state_energy_account_h

#include <cmath>

namespace undine
{
  /// The energy of fluid and bodies at the end of a step, and the power that is put into them there
  /// from outside: by loads, supports, moving walls and obstacles, forces on the fluid, and what
  /// flows in and out. EnergyMonitor compares the two.
  struct EnergyAccount
  {
    /// A power at the end of the step [W].
    void
    add_power(const double more)
    {
      power += more;
      exchange += std::abs(more);
    }

    double energy   = 0; ///< kinetic, elastic and of contact [J]
    double power    = 0; ///< sum of powers [W]
    double exchange = 0; ///< sum of their sizes [W]
    double largest  = 0; ///< energy so far [J]
    double created  = 0; ///< by all steps since it last was lost again [J]
    bool   known    = false;
  };
} // namespace undine

#endif
