// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_run_summary_h
#define undine_driver_run_summary_h

#include <undine/base/options/options.h>
#include <undine/coupled/state/report.h>
#include <undine/driver/certificate.h>
#include <undine/driver/log.h>
#include <undine/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace undine
{
  /// What a run knows at its end, of the steps since its start or since it was taken up again, of
  /// its cost, its stability and its own error, for the user and as the file `summary.json`. Only
  /// what the run has measured is in it: where nothing estimates an error, it says so.
  template <int dim>
  class RunSummary
  {
  public:
    /// The run stands before its first step, set up or taken up again at `start`; `first` is the
    /// report on that. The references must outlive it. Collective.
    RunSummary(const Scene<dim> &scene,
               const Options    &options,
               const Clock      &start,
               const Report     &first);

    /// A step has been made, to `time` [s].
    void
    observe(double time, const Report &report);

    /// Has any step been made? If not, there is nothing to say: an earlier summary stays.
    bool
    has_steps() const
    {
      return n_steps > 0;
    }

    /// A line for each kind of error that the run knows, and whether it was stable, at `time` [s].
    void
    print(Log &log, double time) const;

    /// Why a run ended before its time.
    struct End
    {
      std::string reason;             ///< empty: it has not
      bool        has_failed = false; ///< else it was asked to stop
    };

    /// What there is to say of stability where the run has come to this end, at `time` [s].
    void
    print_failure(Log &log, double time, const End &end) const;

    /// All of it. Collective.
    std::string
    json(const Clock &clock, const End &end) const;

  private:
    /// Of a kind of error: the largest of a dimensionless measure in any step.
    struct Largest
    {
      std::string meaning;
      double      value = 0; ///< [1]
    };
    using Errors = std::vector<std::pair<std::string, Largest>>;

    void
    observe_column(const Columns     &columns,
                   const std::string &name,
                   const std::string &kind,
                   const std::string &meaning);
    void
    raise(const std::string &kind, const std::string &meaning, double value);
    std::string
    costs() const;
    std::string
    unknowns() const;
    std::string
    tolerances() const;
    std::string
    stability_of_splitting() const;

    const Scene<dim> &scene;
    const Options     options;
    const Clock       start;
    const double      core_seconds_of_start; ///< of this rank

    const std::optional<SplittingStability> splitting;

    unsigned int        n_steps = 0, newton_iterations = 0, linear_iterations = 0, cuts = 0;
    std::optional<bool> time_is_estimated; ///< none before the first step
    Errors              errors;
    Certificate         certificate;

    const std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  };
} // namespace undine

#endif
