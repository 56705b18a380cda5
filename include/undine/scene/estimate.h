// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_scene_estimate_h
#define undine_scene_estimate_h

#include <undine/scene/scene_size.h>

#include <string>

namespace undine
{
  /// The memory, time and disk space that a run of a scene will take, from its size and
  /// measurements of other runs (cost_figures.h).
  struct Estimate
  {
    /// By which factors a run may take more or less, as far as has been measured.
    static constexpr double uncertainty_of_memory    = 1.5;
    static constexpr double uncertainty_with_contact = 30; ///< of seconds: few or many may touch
    double                  uncertainty_of_seconds   = 3;

    double program    = 0; ///< memory of a rank before it has read a scene [bytes]
    double memory     = 0; ///< at its largest, of all ranks, the program included [bytes]
    double seconds    = 0; ///< of a step, on a machine like that of the figures [s]
    double picture    = 0; ///< a file of results [bytes]
    double checkpoint = 0; ///< [bytes]

    /// Memory that a rank takes while the scene is read and run [bytes].
    double
    growth_of_rank(unsigned int n_ranks) const
    {
      return memory / n_ranks - program;
    }
  };

  /// The estimate for a scene of this size on `n_ranks` ranks.
  Estimate
  estimate(const SceneSize &size, unsigned int n_ranks);

  /// "1000000 cells, 3456 elements with 31000 unknowns", "about 45000 particles".
  std::string
  describe(const SceneSize &size);
} // namespace undine

#endif
