// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_newton_report_h
#define undine_base_core_newton_report_h

#include <vector>

namespace undine
{
  /// How Newton's method went.
  struct NewtonReport
  {
    unsigned int        iterations        = 0; ///< corrections computed
    unsigned int        tangents          = 0; ///< assembled for them
    unsigned int        cuts              = 0; ///< halvings in the line search
    unsigned int        linear_iterations = 0;
    std::vector<double> residuals; ///< norm before the first and after every correction
    double              scale = 0; ///< size of the terms whose sum the last residual is

    /// `later` went on from here. The linear iterations are counted through.
    void
    append(const NewtonReport &later)
    {
      iterations += later.iterations;
      tangents += later.tangents;
      cuts += later.cuts;
      linear_iterations = later.linear_iterations;
      scale             = later.scale;
      residuals.insert(residuals.end(), later.residuals.begin(), later.residuals.end());
    }
  };
} // namespace undine

#endif
