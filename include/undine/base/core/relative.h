// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_relative_h
#define undine_base_core_relative_h

namespace undine
{
  /// value / scale [1], and 0 / 0 = 0: where nothing is, nothing is missing.
  inline double
  relative(const double value, const double scale)
  {
    return value == 0 ? 0. : value / scale;
  }
} // namespace undine

#endif
