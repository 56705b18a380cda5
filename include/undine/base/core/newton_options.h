// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_newton_options_h
#define undine_base_core_newton_options_h

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
    bool         inexact = true; ///< keep tangents, solve no further than a correction can gain

    /// Not where the number of corrections is given.
    bool
    is_inexact() const
    {
      return inexact && fixed_iterations == 0;
    }
  };
} // namespace undine

#endif
