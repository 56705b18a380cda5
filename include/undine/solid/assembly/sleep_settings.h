// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_sleep_settings_h
#define undine_solid_assembly_sleep_settings_h

namespace undine
{
  /// When bodies fall asleep and wake: those whose nodes have all been slower than V for a time T
  /// sleep, until the loads on their surface have changed by more than m V / T in sum.
  struct SleepSettings
  {
    double speed = 0; ///< V [m/s]
    double time  = 0; ///< T [s]
  };
} // namespace undine

#endif
