// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_certificate_h
#define undine_driver_certificate_h

#include <undine/coupled/budget/energy_input.h>
#include <undine/coupled/state/report.h>
#include <undine/driver/energy_growth.h>
#include <undine/driver/log.h>
#include <undine/driver/margins.h>
#include <undine/driver/swing.h>

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace undine
{
  /// Was a run numerically stable, and why? Fed by the reports of its steps alone, by rules that
  /// are the same for all schemes (doc/hard_cases.md). It covers the steps since the run was
  /// started or taken up again, and changes nothing.
  class Certificate
  {
  public:
    /// What is known of the run besides the reports.
    struct Scope
    {
      /// inertia() of the scene [kg m^2].
      double inertia = 0;
      /// Does nothing but weight do work on fluid and bodies?
      bool is_closed = false;
      /// Is a step a frame of many that are not reported?
      bool steps_are_frames = false;
      /// Longest edge of the fluid's domain [m]; 0: there is none.
      double extent = 0;
    };

    explicit Certificate(const Scope &scope)
      : scope(scope)
    {
    }

    /// The step of the report ends at `time` [s].
    void
    observe(double time, const Report &report);

    /// stable | undecided | growing | failed; the last if a run that ended before its time has
    /// `failure` to tell.
    std::string
    verdict(const std::string &failure) const;

    /// The verdict with its reasons, in one sentence. `time`: at the end [s].
    std::string
    text(double time, const std::string &failure) const;

    /// The verdict and the margins; a warning if the run is not stable. Of one that has failed only
    /// that something grew before.
    void
    print(Log &log, double time, const std::string &failure) const;

    /// As an object of JSON.
    std::string
    json(double time, const std::string &failure) const;

  private:
    /// A force or a velocity that may swing.
    struct Watched
    {
      std::string   where;
      std::size_t   column     = 0; ///< of the first component
      unsigned int  components = 0;
      bool          is_body    = false;
      bool          moves      = false; ///< a place, of which the velocity is watched
      Swing::Signal place{};
      Swing         swing;
    };

    void
    find_columns(const Columns &columns);
    EnergyGrowth::Step
    energies(double time, const Report &report);
    std::optional<Swing::Signal>
    signal_of(Watched &each, const Report &report) const;
    void
    watch(double time, double energy, const Report &report);
    void
    locate_growth_of_energy();
    std::optional<Growth>
    growth() const;
    std::optional<Growth>
    apparent_growth() const;
    std::optional<Growth>
    past() const;
    bool
    is_too_short_to_tell() const;
    std::string
    violated() const;
    std::string
    redone() const;

    const Scope                  scope;
    std::vector<std::size_t>     energy_of_fluid, energy_of_bodies, potential;
    std::optional<std::size_t>   particles; ///< column of their number
    std::vector<Watched>         watched;
    EnergyGrowth                 energy;
    Margins                      margins;
    std::optional<EnergyAccount> last_account;
    std::deque<double> of_fluid, of_bodies; ///< energies at the ends of the last steps [J]
    double             last_potential = 0, largest_potential = 0; ///< [J]
    double             largest_force = 0, largest_velocity = 0;   ///< of all watched [N], [m/s]
    std::string        where, mode;                               ///< of the energy that grows
    unsigned int       located_over = 0, n_steps = 0, n_redone = 0, n_by_fallback = 0;
  };
} // namespace undine

#endif
