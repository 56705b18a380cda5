// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_effects_report_h
#define undine_driver_effects_report_h

#include <undine/base/core/timing.h>
#include <undine/driver/advice.h>
#include <undine/driver/log.h>
#include <undine/scene/scene.h>

#include <string>
#include <vector>

namespace undine
{
  /// Which effects a scene calls for, why, and what each of them costs: in the log, and as the file
  /// `effects.json`.
  template <int dim>
  class EffectsReport
  {
  public:
    /// At the start of a run, when all is set up. The references must outlive it. Collective.
    EffectsReport(const Scene<dim> &scene, const TimingTree &timing);

    /// Each effect, on or off, its memory, and why. Collective.
    void
    print_start(Log &log) const;

    /// The cost so far of each effect that is on, and the advice. Collective.
    void
    print_end(Log &log, const Advice &advice) const;

    /// All of it, with the advice, as the text of `effects.json`. Collective.
    std::string
    json(const Advice &advice) const;

  private:
    struct Row
    {
      std::string              name;
      bool                     is_on;
      std::string              why;
      std::string              rule;
      std::vector<std::string> phases;          ///< of the timing
      double                   start_bytes = 0; ///< of all ranks
    };

    struct Cost
    {
      double        seconds    = 0; ///< of the slowest rank
      unsigned long calls      = 0; ///< of the first rank
      double        peak_bytes = 0; ///< of all ranks
    };

    void
    add_effects(const Scene<dim> &scene);
    void
    add_implied_effects(const Scene<dim> &scene);
    Cost
    cost(const Row &row) const;

    const TimingTree &timing;
    const MPI_Comm    communicator;
    std::vector<Row>  rows;
  };
} // namespace undine

#endif
