// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/state/splitting_stability.h>

#include <fmt/format.h>

#include <cmath>

namespace undine
{
  namespace
  {
    // A motion without a force, whose displacement grows linearly, is a double eigenvalue 1, which
    // is known to the root of the accuracy of others.
    constexpr double next_to_one = 1.001;
  } // namespace


  std::string
  SplittingStability::text() const
  {
    if (!std::isfinite(added_mass_ratio))
      return "time splitting has no solution: bodies close off a part of the fluid";
    const auto fate = [](const double growth) {
      if (std::isnan(growth))
        return std::string("may grow or not (Arnoldi's method did not converge)");
      return growth > next_to_one ? fmt::format("grow by a factor of {:.4g} a step", growth)
                                  : std::string("do not grow");
    };
    return fmt::format("time splitting by linear theory: added mass over inertia up to {:.4g}; "
                       "driven by velocity small motions {}, by displacement they {}",
                       added_mass_ratio,
                       fate(growth_by_velocity),
                       fate(growth_by_displacement));
  }
} // namespace undine
