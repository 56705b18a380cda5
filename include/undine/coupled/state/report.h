// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_state_report_h
#define undine_coupled_state_report_h

#include <undine/base/core/column.h>

#include <optional>
#include <string>

namespace undine
{
  /// How an accepted step went.
  struct Report
  {
    double       dt                = 0; ///< the step that was accepted [s]
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0; ///< of all linear solves of the step
    unsigned int cuts              = 0; ///< how often the asked step was cut and redone
    unsigned int rejections        = 0; ///< those of the cuts that the error in time asked for
    double       newton_reduction = 0; ///< last residual norm of Newton's method over the first [1]
    std::string  note;                 ///< what was unusual; empty if nothing was

    /// Where steps are chosen by their error in time: that of all steps so far [1].
    std::optional<double> error_in_time;

    Columns columns; ///< energies, forces, fluxes, ... of the new state
  };

  /// Throws SolveError naming the first quantity that is no finite number.
  void
  assert_finite(const Columns &columns);
} // namespace undine

#endif
