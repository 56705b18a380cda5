// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/step_limit.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    constexpr unsigned int most_patience = 32;
  } // namespace


  void
  StepLimit::accept(const double dt)
  {
    ++served;
    if (!std::isfinite(longest) || served < patience)
      return;
    const bool binds = 2 * dt > longest; // else steps are that short for another reason
    if (is_doubled || !binds)
      patience = std::max(1u, patience / 2);
    is_doubled = binds;
    longest *= 2;
    served = 0;
  }


  void
  StepLimit::accept_cut(const double dt)
  {
    if (is_doubled)
      patience = std::min(2 * patience, most_patience);
    longest    = dt;
    served     = 0;
    is_doubled = false;
  }
} // namespace undine
