// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_growth_h
#define undine_driver_growth_h

#include <string>

namespace undine
{
  /// Something that grows from step to step although nothing feeds it.
  struct Growth
  {
    double      since  = 0; ///< [s]
    double      until  = 0; ///< when it was last seen to grow [s]
    double      factor = 1; ///< a step, of the energy or of the amplitude [1]
    std::string what;       ///< grows: "energy", "amplitude"
    std::string where;      ///< "body plate", "fluid"
    std::string mode;       ///< "swings from step to step", "period of 3.1 steps", "monotonic"
    std::string doubt;      ///< why it may be none

    /// In words, without the time since when.
    std::string
    text() const;
  };
} // namespace undine

#endif
