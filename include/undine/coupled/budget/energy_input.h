// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_budget_energy_input_h
#define undine_coupled_budget_energy_input_h

#include <undine/coupled/state/energy_account.h>

namespace undine
{
  /// What is put into fluid and bodies from outside in a step, by the rules of (B3).
  struct EnergyInput
  {
    /// In the step of length `dt` [s] from the account `last` to the account `now`. If `last` knows
    /// no power, that of `now` stands for it.
    EnergyInput(const EnergyAccount &last, const EnergyAccount &now, const double dt)
      : by_means(now.work + dt / 2 * ((last.known ? last : now).power + now.power))
      , at_end(now.work_at_end + dt * (now.power - now.doubtful))
      , of_works(now.work_exchange)
      , of_powers(dt / 2 * ((last.known ? last : now).exchange + now.exchange))
    {
    }

    double by_means;  ///< with forces and powers that are the means of both ends [J]
    double at_end;    ///< with those at the end of the step, without what is doubtful [J]
    double of_works;  ///< sum of the sizes of works [J]
    double of_powers; ///< the same of powers, over the step [J]
  };
} // namespace undine

#endif
