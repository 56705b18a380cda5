// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_newton_h
#define undine_base_core_newton_h

#include <undine/base/core/descent.h>
#include <undine/base/core/errors.h>
#include <undine/base/core/trial_points.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace undine
{
  /// Newton's method for r(x) = 0 with a watchdog line search: a full correction is taken as long
  /// as the residual falls; it may rise for a few corrections, as it does when thin bodies bend,
  /// and if it has not fallen below its best by then, the best point is taken up again and its
  /// correction followed down the potential whose gradient is r (Descent), or, where there is none,
  /// halved until the residual falls [Chamberlain, Powell, Lemarechal, Pedersen 1982; Nocedal,
  /// Wright, Numerical Optimization, section 15.6]. After that the residual may not rise any more,
  /// and every correction that does not bring it below its best is halved; but where that gains
  /// little two of them may again: a stiff body that is about to turn far stretches in a full
  /// correction, which the next one takes back, while halved ones lead around in tiny steps.
  ///
  /// It may be inexact: as long as corrections reduce the residual tenfold, those that follow keep
  /// the tangent (the chord method), and the linear solver is not asked for much more than such a
  /// correction can gain [Kelley, Iterative Methods for Linear and Nonlinear Equations, SIAM 1995,
  /// sections 5.4 and 6.1]. A new tangent is kept where the equations look linear, the residual
  /// being about what the linear solver has left, and where that solves exactly, so that tangents
  /// are dear. When it ends is decided by the residual alone, as with a new tangent and a full
  /// solution for every correction.
  template <class Problem>
  class Newton
  {
  public:
    /// `Problem` provides
    ///
    ///     using Unknown          with add(double, const Unknown &)
    ///     double evaluate(x)     norm of r(x), which it keeps; SolveError where r makes no sense
    ///     Unknown correction(x, const CorrectionRequest &)  -A^{-1} r(x) for the x evaluated last
    ///     double slope(const Unknown &)  r . correction for the x evaluated last: the derivative
    ///                                    of the potential, if r is a gradient
    ///     double part_left()     of |r|, that the linear solver has left; 0: next to nothing
    ///     double scale()         size of the terms whose sum is r
    ///     double rounding()      the norm that rounding alone gives r
    ///     unsigned int linear_iterations()  so far
    ///
    /// Norms are all in one unit.
    Newton(Problem &problem, const NewtonOptions &options);

    /// Improve x until |r| <= max(relative tolerance * scale, rounding) (T6). Where no
    /// correction serves before, |r| <= 100 rounding is accepted; else throws SolveError with the
    /// history of |r|. A given number of corrections is done whatever |r| is. `has_tangent`: an
    /// earlier call has left the problem a tangent with which to begin.
    NewtonReport
    solve(typename Problem::Unknown &x, bool has_tangent = false);

  private:
    using Unknown = typename Problem::Unknown;

    static constexpr double enough_to_keep_a_tangent = 0.1;  ///< reduction of the residual [1]
    static constexpr double first_gain               = 1e-3; ///< that a correction is asked for [1]
    static constexpr double beyond_linear = 5;       ///< times what the linear solver leaves [1]
    static constexpr double little_gained = 0.5;     ///< of the residual, by halved corrections [1]
    static constexpr unsigned int relaxed_again = 2; ///< allowance after such a gain

    /// The best point so far, to go back to.
    struct Best
    {
      Unknown x;
      Unknown correction;
      double  residual;
    };

    /// How the correction of an x with this residual is to be computed.
    CorrectionRequest
    request(double residual) const;

    /// How the next one is to be computed follows from what a correction has made of the residual.
    void
    learn_from(const CorrectionRequest &asked, double residual, double before);

    /// Add the correction, or the largest of its halves that is admissible. Returns the residual.
    double
    take_correction(Unknown &x, const Unknown &correction);

    /// From the best point on by other corrections than full ones. False if none serves.
    bool
    recover(Unknown &x, double &residual);

    /// From the best point down the potential. False if that leads to no better one.
    bool
    descend(Unknown &x, double &residual);

    /// Halve the correction of the best point until the residual falls. False if it never does.
    bool
    backtrack(Unknown &x, double &residual);

    bool
    converged(double residual) const;

    /// With a tangent that serves a tenth of what is tolerated is cheap.
    bool
    is_done(double residual) const;

    std::string
    history() const;

    Problem             &problem;
    const NewtonOptions &options;
    TrialPoints<Problem> trials;
    NewtonReport         report;
    Best                 best;
    unsigned int         limit         = 0; ///< of corrections
    unsigned int         allowance     = 0; ///< of corrections that may increase the residual
    unsigned int         relaxed       = 0; ///< corrections since the best point
    bool                 has_recovered = false;
    bool                 keeps_tangent = false;
    double               gain          = first_gain; ///< part of the residual that may be left [1]
  };


  template <class Problem>
  Newton<Problem>::Newton(Problem &problem, const NewtonOptions &options)
    : problem(problem)
    , options(options)
    , trials(problem)
  {
  }


  template <class Problem>
  NewtonReport
  Newton<Problem>::solve(Unknown &x, const bool has_tangent)
  {
    report          = NewtonReport();
    has_recovered   = false;
    gain            = first_gain;
    keeps_tangent   = has_tangent && options.is_inexact();
    double residual = problem.evaluate(x);
    if (!std::isfinite(residual))
      throw SolveError("the forces at the start of the step are not finite numbers. Check the "
                       "scene's expressions (loads, tractions, pressures, motions) at this time.");
    report.residuals.push_back(residual);
    best.residual = std::numeric_limits<double>::infinity();
    allowance     = options.relaxed_steps;
    limit   = options.fixed_iterations > 0 ? options.fixed_iterations : options.maximum_iterations;
    relaxed = 0;
    while (report.iterations < limit && (options.fixed_iterations > 0 || !is_done(residual)))
      {
        const auto asked = request(residual);
        Unknown    correction;
        try
          {
            correction = problem.correction(x, asked);
          }
        catch (const SolveError &) // of factors that are singular, say, away from the best point
          {
            if (options.fixed_iterations > 0 || relaxed == 0 || !recover(x, residual))
              throw;
            continue;
          }
        if (!(residual > best.residual)) // also where only the tangent is another one
          {
            best    = {x, correction, residual};
            relaxed = 0;
          }
        const double before = residual;
        residual            = take_correction(x, correction);
        learn_from(asked, residual, before);
        if (!asked.new_tangent && !(residual < before))
          {
            x        = best.x; // from which this correction went
            residual = problem.evaluate(x);
            continue;
          }
        if (options.fixed_iterations > 0 && std::isinf(residual))
          throw SolveError("the correction cannot be accepted. " + trials.last_refusal());
        if (options.fixed_iterations == 0 && !(residual < best.residual))
          if (std::isinf(residual) || ++relaxed > allowance)
            if (!recover(x, residual))
              break;
        report.residuals.push_back(residual);
      }
    report.linear_iterations = problem.linear_iterations();
    // What rounding leaves where nothing acts is no error.
    report.scale = std::max(problem.scale(), problem.rounding() / options.relative_tolerance);

    if (options.fixed_iterations == 0 && !converged(residual) &&
        !may_be_rounding(problem, residual))
      throw SolveError("Newton's method does not converge. " + history() +
                       (trials.last_refusal().empty() ? // else it says what to try
                          "Try a smaller step, a finer mesh, or more iterations."
                                                      : trials.last_refusal()));
    return report;
  }


  template <class Problem>
  CorrectionRequest
  Newton<Problem>::request(const double residual) const
  {
    // The last correction leaves a hundredth of what is tolerated: a residual that is hidden by
    // another one would show in balances.
    const double tolerated = options.relative_tolerance * problem.scale() / residual;
    const bool   is_last   = !options.is_inexact() || gain <= 10 * tolerated;
    return {!keeps_tangent, std::min(is_last ? 0.01 * tolerated : gain, 1.)};
  }


  template <class Problem>
  void
  Newton<Problem>::learn_from(const CorrectionRequest &asked,
                              const double             residual,
                              const double             before)
  {
    ++report.iterations;
    report.tangents += asked.new_tangent ? 1 : 0;
    const double reduction = residual / before;
    const bool   serves =
      options.is_inexact() && reduction <= enough_to_keep_a_tangent && residual < best.residual;
    const double left      = problem.part_left();
    const bool   is_linear = reduction <= beyond_linear * left;
    keeps_tangent          = serves && (!asked.new_tangent || left == 0 || is_linear);
    gain                   = serves ? std::min(0.1 * reduction, first_gain) : 0;
  }


  template <class Problem>
  double
  Newton<Problem>::take_correction(Unknown &x, const Unknown &correction)
  {
    x.add(1., correction);
    double residual = trials.evaluate(x);
    double length   = 1;
    if (options.fixed_iterations == 0)
      for (unsigned int cut = 0; std::isinf(residual) && cut < options.maximum_cuts; ++cut)
        {
          length /= 2;
          ++report.cuts;
          x.add(-length, correction);
          residual = trials.evaluate(x);
        }
    return residual;
  }


  template <class Problem>
  bool
  Newton<Problem>::recover(Unknown &x, double &residual)
  {
    const bool first = !has_recovered;
    has_recovered    = true;
    allowance        = 0;
    relaxed          = 0;
    if (first && !may_be_rounding(problem, best.residual) && descend(x, residual))
      return true;
    return backtrack(x, residual);
  }


  template <class Problem>
  bool
  Newton<Problem>::descend(Unknown &x, double &residual)
  {
    x                     = best.x;
    residual              = problem.evaluate(x);
    keeps_tangent         = false;
    const auto iterations = report.iterations;
    const bool is_solved  = Descent<Problem>(problem, options, trials, report).solve(x, residual);
    limit += report.iterations - iterations;
    if (is_solved)
      return true;
    // The sizes of terms on the way may have made another unit of |r|.
    best.residual = problem.evaluate(best.x);
    if (!(residual < best.residual))
      return false;
    residual = problem.evaluate(x);
    return true;
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
        residual = trials.evaluate(x);
        if (residual < (1 - 1e-4 * length) * best.residual)
          {
            if (residual > little_gained * best.residual)
              allowance = std::min(options.relaxed_steps, relaxed_again);
            return true;
          }
      }
    x        = best.x;
    residual = problem.evaluate(x);
    return false;
  }


  template <class Problem>
  bool
  Newton<Problem>::converged(const double residual) const
  {
    return has_converged(problem, options, residual);
  }


  template <class Problem>
  bool
  Newton<Problem>::is_done(const double residual) const
  {
    return converged(residual) && (!keeps_tangent || converged(10 * residual));
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


  /// Solve problem(x) = 0 from the guess x; see Newton::solve().
  template <class Problem>
  NewtonReport
  solve_newton(Problem                   &problem,
               typename Problem::Unknown &x,
               const NewtonOptions       &options,
               const bool                 has_tangent = false)
  {
    return Newton<Problem>(problem, options).solve(x, has_tangent);
  }
} // namespace undine

#endif
