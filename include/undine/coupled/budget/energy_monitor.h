// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_budget_energy_monitor_h
#define undine_coupled_budget_energy_monitor_h

#include <undine/base/core/column.h>
#include <undine/base/options/options.h>
#include <undine/coupled/model/models.h>
#include <undine/coupled/state/energy_account.h>
#include <undine/coupled/state/report.h>
#include <undine/coupled/state/state.h>

#include <optional>
#include <string>

namespace undine
{
  /// Compares the energy that fluid and bodies gain in a step with the work that is put into them
  /// from outside, and rejects steps that create energy. It knows nothing of how a step is made,
  /// nor of the terms of Budget: energies are those of the columns, and the work is that of the
  /// mean of the powers at both ends of the step,
  ///
  ///     created = E^{n+1} - E^n - h (P^n + P^{n+1}) / 2                            [J]     (B3)
  ///
  /// It may be a tenth of E^n and of the work of the sizes of all powers: so much is the error of
  /// that rule in steps that only just resolve what happens. The work may also be h P^{n+1}, that
  /// of forces which act at the end of the step, where a power rises within few steps. The first
  /// step of a run, which may begin with a jump and for which there is no P^n, is not judged.
  class EnergyMonitor
  {
  public:
    enum class Response
    {
      none, ///< there is no monitor, and no cost
      warn,
      redo ///< with a shorter step, as long as that creates less
    };

    /// `Energy monitor` of the section `Time`, with the response as its default.
    void
    add_options(const Options &time, Response response);

    /// `state` at the start of a run, of the given columns, gets an account, if there is a monitor.
    /// Collective.
    template <int dim>
    void
    start(const Models<dim> &models, State<dim> &state, const Columns &columns);

    /// A step is tried: its report gets an empty account, if there is a monitor.
    void
    begin_step(Report &report) const;

    /// The step has led from the time of `account` to the columns of `report`, whose account
    /// becomes `account` if the step is accepted. Adds a warning where energy is created all the
    /// same. Throws SolveError if the step is to be redone, which it never is unless `can_be_cut`.
    void
    judge(std::optional<EnergyAccount> &account, Report &report, bool can_be_cut) const;

  private:
    /// What the energy created in a step of the account `now` is compared with [J].
    double
    scale(const EnergyAccount &last, const EnergyAccount &now, double dt) const;

    std::string response;    ///< off | warn | redo
    double      inertia = 0; ///< sum of mass and the square of its extent [kg m^2]
  };
} // namespace undine

#endif
