// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_state_report_h
#define undine_coupled_state_report_h

#include <undine/base/core/column.h>
#include <undine/coupled/state/energy_account.h>
#include <undine/coupled/state/splitting_stability.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace undine
{
  /// The report on an accepted step.
  struct Report
  {
    double       dt                = 0; ///< the step that was accepted [s]
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;     ///< of all linear solves of the step
    unsigned int cuts              = 0;     ///< how often the asked step was cut and redone
    unsigned int halvings          = 0;     ///< of the asked step
    unsigned int rejections        = 0;     ///< those of the cuts that the error in time asked for
    bool         is_by_fallback    = false; ///< by implicit Euler in the place of the integrator
    bool         tries_stages      = false; ///< once implicit Euler, which began, could not end it
    unsigned int stages_again      = 0;     ///< solved again: bodies were elsewhere or faster
    double       newton_reduction = 0; ///< last residual norm of Newton's method over the first [1]
    double       newton_residual  = 0; ///< the same over the size of the forces that it sums [1]
    std::string  note;                 ///< what the user may want to know; empty if nothing

    /// Something unusual. Users are told once, as long as each step has one of the same subject.
    struct Warning
    {
      std::string subject;
      std::string text;
    };
    std::vector<Warning> warnings; ///< at most one a subject: that of the first stage that had one

    /// Add a warning unless `text` is empty.
    void
    warn(const std::string &subject, const std::string &text);

    /// The error in time of all steps so far [1], if steps are chosen by it.
    std::optional<double> error_in_time;

    /// By how much fluid and bodies have changed of late, Steadiness [1]; only where they are
    /// steady, so that the run is over.
    std::optional<double> steady;

    /// The energy of the new state, if EnergyMonitor asks for it.
    std::optional<EnergyAccount> account;
    double share_created = 0; ///< of the energy and of what goes in and out [1]

    /// The tries of the step that EnergyMonitor did not accept.
    struct Creations
    {
      unsigned int number        = 0;
      unsigned int vain          = 0; ///< the last ones, which have created no less
      double       least_energy  = 0; ///< the least that was created [J]
      double       best_share    = 0; ///< of the energy and of what goes in and out, in that try
      unsigned int best_halvings = 0; ///< of the asked step, in that try
      bool         best_is_by_fallback = false;
      bool         are_over            = false; ///< that try is carried out again, and accepted

      /// Shorter steps cannot be computed: is there a try to go back to? Then it is gone back to.
      bool
      end()
      {
        return number > 0 && !std::exchange(are_over, true);
      }
    } creations;

    /// At the start of a run, if the scene asks for it.
    std::optional<SplittingStability> splitting;

    Columns columns; ///< energies, forces, fluxes, probes, ... of the new state
  };

  /// The texts of those warnings of `now` of whose subjects there was none in `before`.
  std::vector<std::string>
  new_warnings(const std::vector<Report::Warning> &now, const std::vector<Report::Warning> &before);

  /// Throws SolveError naming the first quantity that is no finite number.
  void
  assert_finite(const Columns &columns);
} // namespace undine

#endif
