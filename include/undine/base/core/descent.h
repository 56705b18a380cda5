// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_descent_h
#define undine_base_core_descent_h

#include <undine/base/core/correction_request.h>
#include <undine/base/core/newton_options.h>
#include <undine/base/core/newton_report.h>
#include <undine/base/core/trial_points.h>

#include <algorithm>
#include <cmath>
#include <utility>

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


  /// May what is left of r(x) be rounding, which may end the descent somewhat above the estimate of
  /// its size?
  template <class Problem>
  bool
  may_be_rounding(const Problem &problem, const double residual)
  {
    return residual <= 100 * problem.rounding();
  }


  /// Newton's method for a minimum of a potential whose gradient is r. Where the potential is not
  /// convex, as where nodes of two surfaces press on each other and are about to slip, |r| has
  /// least values that are no solutions, with a tangent that is nearly singular, and a line search
  /// that wants |r| to fall ends there. Here each correction is to lower the potential, of which
  /// the slopes along the correction are all that has to be known: a length serves once the
  /// potential still falls at its end or does not rise by more than half as steeply as it fell at
  /// the begin (S23) [Matthies, Strang, Int. J. Numer. Methods Eng. 14 (1979) 1613]. Directions
  /// come from a convex tangent, and from the exact one as long as full corrections by it serve
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

    /// Improve x, evaluated last, whose residual is `residual`, as far as is asked for or rounding
    /// allows. False if corrections are used up, or lead upwards, so that r is no gradient, or the
    /// convex tangent is not convex. x is then where corrections led.
    bool
    solve(Unknown &x, double &residual);

  private:
    /// Corrections of its own, in proportion to those of Newton's method.
    static constexpr unsigned int share_of_corrections = 2;

    /// Reduction of |r| from which on it alone may decide: slopes may be rounding [1].
    static constexpr double close = 1e-4;

    /// The part of a correction that has been taken, 0 if none serves; x is then where it was.
    double
    correct(Unknown &x, double &residual, Tangent tangent, bool is_close);

    /// The largest part of a correction, of those that are tried, that serves, but no less than
    /// `least`. 0 if there is none; x is then where it was.
    double
    search(Unknown &x, double &residual, const Unknown &correction, double slope, double least);

    /// Does a point serve, with the slope `at_end` there?
    static bool
    serves(double residual, double before, double at_end, double slope);

    Problem              &problem;
    const NewtonOptions  &options;
    TrialPoints<Problem> &trials;
    NewtonReport         &report;
    bool                  is_first = true; ///< no correction has been taken
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
    const double first   = residual;
    auto         tangent = Tangent::convex;
    for (unsigned int wait = 1, waited = 0; !has_converged(problem, options, residual);)
      {
        if (report.iterations == limit)
          return false;
        const double before   = residual;
        const bool   is_exact = tangent == Tangent::exact;
        const double part     = correct(x, residual, tangent, residual <= close * first);
        if (part > 0)
          report.residuals.push_back(residual);
        if (may_be_rounding(problem, residual) && !(residual <= 0.5 * before))
          return true;
        if (part == 0 && !is_exact)
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
  Descent<Problem>::correct(Unknown      &x,
                            double       &residual,
                            const Tangent tangent,
                            const bool    is_close)
  {
    const bool   is_exact  = tangent == Tangent::exact;
    const double tolerated = options.relative_tolerance * problem.scale() / residual;
    ++report.iterations;
    ++report.tangents;
    try
      {
        const auto correction =
          problem.correction(x, {true, std::min(0.01 * tolerated, 1.), tangent});
        const double slope = problem.slope(correction);
        // Other unknowns, which follow from linear equations, need not fit yet: then the first
        // slope is not that of the potential. They do after a full correction.
        const bool may_rise = is_exact ? is_close : std::exchange(is_first, false);
        // An exact tangent is not worth a search: where it does not serve, it is nearly singular.
        const double least = is_exact || !(slope < 0) ? 1 : std::pow(0.5, options.maximum_cuts);
        return slope < 0 || may_rise ? search(x, residual, correction, slope, least) : 0;
      }
    catch (const SolveError &) // of factors that are singular, say
      {
        residual = problem.evaluate(x);
        return 0;
      }
  }


  template <class Problem>
  double
  Descent<Problem>::search(
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
        if (is_real && serves(residual, before, at_end, slope))
          return part;
        // The secant's zero, and not much less.
        part *= is_real ? std::clamp(slope / (slope - at_end), 0.1, 0.5) : 0.5;
        if (!(part >= least))
          x.add(-last, correction);
      }
    residual = problem.evaluate(x);
    return 0;
  }


  template <class Problem>
  bool
  Descent<Problem>::serves(const double residual,
                           const double before,
                           const double at_end,
                           const double slope)
  {
    const bool is_halved = residual <= 0.5 * before;
    return slope < 0 ? at_end <= -0.5 * slope || (is_halved && at_end <= -slope) : is_halved;
  }
} // namespace undine

#endif
