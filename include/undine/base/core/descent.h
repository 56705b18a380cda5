// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_descent_h
#define undine_base_core_descent_h

#include <undine/base/core/correction_request.h>
#include <undine/base/core/newton_options.h>
#include <undine/base/core/newton_report.h>
#include <undine/base/core/trial_points.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  /// Is r(x) zero, as far as is asked for or rounding allows (T6)?
  template <class Problem>
  bool
  has_converged(const Problem &problem, const NewtonOptions &options, const double residual)
  {
    return residual <= options.relative_tolerance * problem.scale() ||
           residual <= problem.rounding();
  }


  /// Newton's method for a minimum of a potential whose gradient is r. Where the potential is not
  /// convex, as where nodes of two surfaces press on each other and are about to slip, |r| has
  /// least values that are no solutions, with a tangent that is nearly singular, and a line search
  /// that wants |r| to fall ends there. Here each correction must lower the potential, of which the
  /// slopes along the correction are all that has to be known: a length serves once the potential
  /// still falls at its end or does not rise by more than half as steeply as it fell at the begin
  /// (S23) [Matthies, Strang, Int. J. Numer. Methods Eng. 14 (1979) 1613]. Directions come from a
  /// convex tangent, and from the exact one as long as it gives full corrections that halve |r|
  /// (projected Newton: Nocedal, Wright, Numerical Optimization, section 3.4).
  template <class Problem>
  class Descent
  {
  public:
    using Unknown = typename Problem::Unknown;

    /// `Problem`: see Newton. The references must outlive it; corrections are counted in `report`.
    Descent(Problem              &problem,
            const NewtonOptions  &options,
            TrialPoints<Problem> &trials,
            NewtonReport         &report);

    /// Improve x, evaluated last, whose residual is `residual`. False if corrections are used up,
    /// or lead upwards, so that r is no gradient, or the convex tangent is not convex.
    bool
    solve(Unknown &x, double &residual);

  private:
    /// Corrections of its own, in proportion to those of Newton's method.
    static constexpr unsigned int share_of_corrections = 2;

    /// Reduction of |r| from which on it alone may decide [1].
    static constexpr double close = 1e-4;

    /// Halves |r|, or lets the potential fall, on a part of the correction. Returns that part, 0 if
    /// there is none; x is then where it was.
    double
    take_part(Unknown &x, double &residual, const Unknown &correction, double slope, double least);

    Problem              &problem;
    const NewtonOptions  &options;
    TrialPoints<Problem> &trials;
    NewtonReport         &report;
  };


  template <class Problem>
  Descent<Problem>::Descent(Problem              &problem,
                            const NewtonOptions  &options,
                            TrialPoints<Problem> &trials,
                            NewtonReport         &report)
    : problem(problem)
    , options(options)
    , trials(trials)
    , report(report)
  {
  }


  template <class Problem>
  bool
  Descent<Problem>::solve(Unknown &x, double &residual)
  {
    const unsigned int limit =
      report.iterations + share_of_corrections * options.maximum_iterations;
    const double first    = residual;
    const double shortest = std::pow(0.5, options.maximum_cuts);
    auto         tangent  = Tangent::convex;
    for (unsigned int wait = 1, waited = 0; !has_converged(problem, options, residual);)
      {
        if (report.iterations == limit)
          return false;
        const double tolerated = options.relative_tolerance * problem.scale() / residual;
        const auto   correction =
          problem.correction(x, {true, std::min(0.01 * tolerated, 1.), tangent});
        ++report.iterations;
        ++report.tangents;
        const bool   is_exact = tangent == Tangent::exact;
        const double slope    = problem.slope(correction);
        // Close to a solution the residual tells: there slopes may be rounding.
        const bool leads_on = slope < 0 || (is_exact && residual <= close * first);
        if (!is_exact && !leads_on)
          return false;
        // An exact tangent is not worth a search: where it does not serve, it is nearly singular.
        const double part =
          leads_on ? take_part(x, residual, correction, slope, is_exact ? 1 : shortest) : 0;
        if (part > 0)
          report.residuals.push_back(residual);
        else if (!is_exact)
          return false;

        if (is_exact)
          wait = part > 0 ? 1 : 2 * wait;
        waited  = is_exact ? 0 : waited + 1;
        tangent = part == 1 && (is_exact || waited >= wait) ? Tangent::exact : Tangent::convex;
      }
    return true;
  }


  template <class Problem>
  double
  Descent<Problem>::take_part(
    Unknown &x, double &residual, const Unknown &correction, const double slope, const double least)
  {
    const double before = residual;
    for (double part = 1, last = 0; part >= least; ++report.cuts)
      {
        x.add(part - last, correction);
        last                 = part;
        residual             = trials.evaluate(x);
        const bool   is_real = std::isfinite(residual);
        const double at_end  = is_real ? problem.slope(correction) : 0;
        if (is_real && (residual <= 0.5 * before || (slope < 0 && at_end <= -0.5 * slope)))
          return part;
        // The secant's zero, and not much less.
        part *= is_real ? std::clamp(slope / (slope - at_end), 0.1, 0.5) : 0.5;
        if (!(part >= least))
          x.add(-last, correction);
      }
    residual = problem.evaluate(x);
    return 0;
  }
} // namespace undine

#endif
