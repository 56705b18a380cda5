// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_barrier_h
#define undine_contact_barrier_h

#include <cmath>

namespace undine
{
  /// b(s) = -(s - 1)^2 ln s of a distance s relative to that where contact begins, 0 < s; zero with
  /// two continuous derivatives for s >= 1 [Li, Ferguson, Schneider, Langlois, Zorin, Panozzo,
  /// Jiang, Kaufman, ACM Trans. Graph. 39 (2020), equation 6]. @{
  inline double
  barrier(const double s)
  {
    return s < 1 ? -(s - 1) * (s - 1) * std::log(s) : 0;
  }

  inline double
  barrier_slope(const double s)
  {
    return s < 1 ? (1 - s) * (2 * std::log(s) - (1 - s) / s) : 0;
  }

  inline double
  barrier_curvature(const double s)
  {
    const double r = (1 - s) / s;
    return s < 1 ? -2 * std::log(s) + 4 * r + r * r : 0;
  }
  /// @}
} // namespace undine

#endif
