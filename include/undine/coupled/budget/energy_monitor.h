// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_budget_energy_monitor_h
#define undine_coupled_budget_energy_monitor_h

#include <undine/base/core/column.h>
#include <undine/base/core/errors.h>
#include <undine/base/options/options.h>
#include <undine/coupled/budget/energy_input.h>
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
  /// nor of the terms of Budget: energies are those of the columns, the work W is that of forces
  /// over the way of bodies, and where only powers are known that of their mean at both ends,
  ///
  ///     created = E^{n+1} - E^n - W - h (P^n + P^{n+1}) / 2                        [J]     (B3)
  ///
  /// A step may create a tenth of E^n, of the works and of the work of the sizes of all powers: so
  /// much is the error of that rule in steps that only just resolve what happens. Instead of their
  /// means forces and powers may also be those at the end of the step, where they rise within few.
  /// Steps that create less add up: together, less what is lost again or was lost before, up to
  /// three times as much, they may create a two-hundredth of the largest energy so far, and what
  /// (B3) may be off by. For the first step of a run, which may begin with a jump, there is no P^n.
  /// It is not judged if powers matter in it.
  class EnergyMonitor
  {
  public:
    enum class Response
    {
      none, ///< there is no monitor, and no cost
      warn,
      redo ///< with a shorter step, as long as that creates less
    };

    /// A step has been cut as often as that helps: it is to be redone with the length that created
    /// least, and accepted.
    struct NoShorterStep : SolveError
    {
      using SolveError::SolveError;
    };

    /// `Time / Energy monitor`, with the response as its default, and `Output / Energy account`.
    void
    add_options(const Options &options, Response response);

    /// `state` at the start of a run, of the given columns, gets an account, if there is a monitor,
    /// and the columns those of the account, if the scene asks for them. Throws InputError if it
    /// does so where no account can be kept. Collective.
    template <int dim>
    void
    start(const Models<dim> &models, State<dim> &state, Columns &columns);

    /// A step from `state` is tried: its report gets an empty account, if there is a monitor.
    template <int dim>
    void
    begin_step(State<dim> &state, Report &report) const;

    /// The step has led to `state`, but for its account, and to the columns of `report`, whose
    /// account that of `state` becomes if the step is accepted. Adds a warning where energy is
    /// created all the same. Throws SolveError if the step is to be redone, which it never is
    /// unless `can_be_cut`.
    template <int dim>
    void
    judge(State<dim> &state, Report &report, bool can_be_cut) const;

  private:
    struct Creation;

    Creation
    created(const EnergyAccount &last, const EnergyAccount &now, double dt) const;
    void
    respond(const Creation &step, Report &report, bool can_be_cut) const;
    void
    add_columns(Columns &columns, const EnergyAccount &account, const EnergyInput &input) const;

    std::string response;               ///< off | warn | redo
    bool        writes_columns = false; ///< of the account
    double      moment         = 0;     ///< inertia() [kg m^2]
  };
} // namespace undine

#endif
