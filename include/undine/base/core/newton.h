// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_newton_h
#define undine_base_core_newton_h

#include <undine/base/core/errors.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace undine
{
  /// How Newton's method stops and how carefully it goes.
  struct NewtonOptions
  {
    double       relative_tolerance = 1e-10; ///< of the problem's scale [1]
    unsigned int maximum_iterations = 40;
    unsigned int fixed_iterations   = 0;  ///< do exactly so many, converged or not; 0: converge
    unsigned int maximum_cuts       = 10; ///< halvings of one correction in the line search
    unsigned int relaxed_steps      = 8;  ///< full corrections that may increase the residual
  };

  /// How it went.
  struct NewtonReport
  {
    unsigned int        iterations        = 0; ///< corrections computed
    unsigned int        cuts              = 0; ///< halvings in the line search
    unsigned int        linear_iterations = 0;
    std::vector<double> residuals; ///< norm before the first and after every correction
    double              scale = 0; ///< size of the terms whose sum the last residual is

    /// `later` went on from here. The linear iterations are counted through.
    void
    append(const NewtonReport &later)
    {
      iterations += later.iterations;
      cuts += later.cuts;
      linear_iterations = later.linear_iterations;
      scale             = later.scale;
      residuals.insert(residuals.end(), later.residuals.begin(), later.residuals.end());
    }
  };

  /// Newton's method for r(x) = 0 with a watchdog line search: a full correction is taken as long
  /// as the residual falls; it may rise for a few corrections, as it does when thin bodies bend,
  /// and if it has not fallen below its best by then, the best point is taken up again and its
  /// correction halved until the residual falls [Chamberlain, Powell, Lemarechal, Pedersen 1982;
  /// Nocedal, Wright, Numerical Optimization, section 15.6]. After that the residual may not rise
  /// any more: every correction that does not bring it below its best is halved.
  template <class Problem>
  class Newton
  {
  public:
    /// `Problem` provides
    ///
    ///     using Unknown          with add(double, const Unknown &)
    ///     double evaluate(x)     norm of r(x), which it keeps; SolveError where r makes no sense
    ///     Unknown correction(x)  -r'(x)^{-1} r(x) for the x evaluated last
    ///     double scale()         size of the terms whose sum is r
    ///     double rounding()      the norm that rounding alone gives r
    ///     unsigned int linear_iterations()  so far
    ///
    /// Norms are all in one unit.
    Newton(Problem &problem, const NewtonOptions &options);

    /// Improve x until |r| <= max(relative tolerance * scale, rounding) (T6). Where the descent
    /// ends before, |r| <= 100 rounding is accepted; else throws SolveError with the history of
    /// |r|. A given number of corrections is done whatever |r| is.
    NewtonReport
    solve(typename Problem::Unknown &x);

  private:
    using Unknown = typename Problem::Unknown;

    /// The best point so far, to go back to.
    struct Best
    {
      Unknown x;
      Unknown correction;
      double  residual;
    };

    /// Infinite where x is inadmissible.
    double
    try_to_evaluate(const Unknown &x);

    /// Add the correction, or the largest of its halves that is admissible. Returns the residual.
    double
    take_correction(Unknown &x, const Unknown &correction);

    /// Halve the correction of the best point until the residual falls. False if it never does.
    bool
    backtrack(Unknown &x, double &residual);

    bool
    converged(double residual) const;

    std::string
    history() const;

    Problem             &problem;
    const NewtonOptions &options;
    NewtonReport         report;
    Best                 best;
    unsigned int         relaxed = 0; ///< corrections since the best point
    std::string          last_refusal;
  };


  template <class Problem>
  Newton<Problem>::Newton(Problem &problem, const NewtonOptions &options)
    : problem(problem)
    , options(options)
  {
  }


  template <class Problem>
  NewtonReport
  Newton<Problem>::solve(Unknown &x)
  {
    report          = NewtonReport();
    double residual = problem.evaluate(x);
    if (!std::isfinite(residual))
      throw SolveError("the forces at the start of the step are not finite numbers. Check the "
                       "scene's expressions (loads, tractions, pressures, motions) at this time.");
    report.residuals.push_back(residual);
    best.residual          = std::numeric_limits<double>::infinity();
    unsigned int allowance = options.relaxed_steps;

    const unsigned int limit =
      options.fixed_iterations > 0 ? options.fixed_iterations : options.maximum_iterations;
    while (report.iterations < limit && (options.fixed_iterations > 0 || !converged(residual)))
      {
        const Unknown correction = problem.correction(x);
        if (residual < best.residual)
          {
            best    = {x, correction, residual};
            relaxed = 0;
          }
        residual = take_correction(x, correction);
        ++report.iterations;
        if (options.fixed_iterations > 0 && std::isinf(residual))
          throw SolveError("the correction cannot be accepted. " + last_refusal);
        if (options.fixed_iterations == 0 && !(residual < best.residual))
          if (std::isinf(residual) || ++relaxed > allowance)
            {
              allowance = 0;
              relaxed   = 0;
              if (!backtrack(x, residual))
                break;
            }
        report.residuals.push_back(residual);
      }
    report.linear_iterations = problem.linear_iterations();
    report.scale             = problem.scale();

    // Rounding may stop the descent somewhat above the estimate of its size.
    const double stagnation = 100 * problem.rounding();
    if (options.fixed_iterations == 0 && !converged(residual) && !(residual <= stagnation))
      throw SolveError("Newton's method does not converge. " + history() +
                       (last_refusal.empty() ? // else it says what to try
                          "Try a smaller step, a finer mesh, or more iterations."
                                             : last_refusal));
    return report;
  }


  template <class Problem>
  double
  Newton<Problem>::try_to_evaluate(const Unknown &x)
  {
    try
      {
        const double residual = problem.evaluate(x);
        return std::isfinite(residual) ? residual : std::numeric_limits<double>::infinity();
      }
    catch (const SolveError &error)
      {
        last_refusal = std::string("Last refused: ") + error.what();
        return std::numeric_limits<double>::infinity();
      }
  }


  template <class Problem>
  double
  Newton<Problem>::take_correction(Unknown &x, const Unknown &correction)
  {
    x.add(1., correction);
    double residual = try_to_evaluate(x);
    double length   = 1;
    if (options.fixed_iterations == 0)
      for (unsigned int cut = 0; std::isinf(residual) && cut < options.maximum_cuts; ++cut)
        {
          length /= 2;
          ++report.cuts;
          x.add(-length, correction);
          residual = try_to_evaluate(x);
        }
    return residual;
  }


  template <class Problem>
  bool
  Newton<Problem>::backtrack(Unknown &x, double &residual)
  {
    double length = 1;
    for (unsigned int cut = 0; cut < options.maximum_cuts; ++cut)
      {
        length /= 2;
        ++report.cuts;
        x = best.x;
        x.add(length, best.correction);
        residual = try_to_evaluate(x);
        if (residual < (1 - 1e-4 * length) * best.residual)
          return true;
      }
    x        = best.x;
    residual = problem.evaluate(x);
    return false;
  }


  template <class Problem>
  bool
  Newton<Problem>::converged(const double residual) const
  {
    return residual <= options.relative_tolerance * problem.scale() ||
           residual <= problem.rounding();
  }


  template <class Problem>
  std::string
  Newton<Problem>::history() const
  {
    std::ostringstream text;
    text << "Norms of the residual:";
    for (const double residual : report.residuals)
      text << ' ' << residual;
    text << ", of its terms: " << problem.scale() << ". ";
    return text.str();
  }


  /// Solve problem(x) = 0 from the guess x.
  template <class Problem>
  NewtonReport
  solve_newton(Problem &problem, typename Problem::Unknown &x, const NewtonOptions &options)
  {
    return Newton<Problem>(problem, options).solve(x);
  }
} // namespace undine

#endif
