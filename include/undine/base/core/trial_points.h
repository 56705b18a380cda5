// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_trial_points_h
#define undine_base_core_trial_points_h

#include <undine/base/core/errors.h>

#include <cmath>
#include <limits>
#include <string>

namespace undine
{
  /// Points of a line search, where r(x) may make no sense: inverted elements, say. `Problem` is
  /// that of Newton.
  template <class Problem>
  class TrialPoints
  {
  public:
    explicit TrialPoints(Problem &problem)
      : problem(problem)
    {
    }

    /// |r(x)|, infinite where x is inadmissible.
    double
    evaluate(const typename Problem::Unknown &x)
    {
      try
        {
          const double residual = problem.evaluate(x);
          return std::isfinite(residual) ? residual : std::numeric_limits<double>::infinity();
        }
      catch (const SolveError &error)
        {
          refusal = std::string("Last refused: ") + error.what();
          return std::numeric_limits<double>::infinity();
        }
    }

    /// Why a point was inadmissible, the last time; empty if all were admissible.
    const std::string &
    last_refusal() const
    {
      return refusal;
    }

  private:
    Problem    &problem;
    std::string refusal;
  };
} // namespace undine

#endif
