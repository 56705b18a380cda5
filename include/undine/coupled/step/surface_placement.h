// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_surface_placement_h
#define undine_coupled_step_surface_placement_h

#include <undine/base/core/errors.h>
#include <undine/coupled/immersed/aitken_relaxation.h>
#include <undine/coupled/step/misplacement.h>

#include <limits>
#include <vector>

namespace undine
{
  /// Where a stage cuts the grid so that surfaces end it there: a fixed-point iteration. Bodies are
  /// where they are expected to second order in the step; light ones that shake from stage to stage
  /// are not.
  template <int dim>
  class SurfacePlacement
  {
  public:
    using Positions = std::vector<dealii::Point<dim>>;

    /// The models must outlive it.
    explicit SurfacePlacement(const Models<dim> &models)
      : models(models)
    {
    }

    /// The grid was cut by surfaces with nodes `at` [m], which came to `reached`, `by` from there:
    /// is that close enough? Throws SolveError if it is not and will not be.
    bool
    accepts(const Positions &at, const Positions &reached, const Misplacement &by)
    {
      misplacements.push_back(by);
      if (by.cells <= (round < most_rounds ? small_misplacement : largest_misplacement))
        return true;
      if (by.cells < lowest)
        {
          lowest = by.cells;
          best   = at;
        }
      if (round > most_rounds || (round == most_rounds && lowest > largest_misplacement))
        throw SolveError(misplacement_complaint(models, reached, misplacements));
      return false;
    }

    /// Where to cut the grid next, after a place that was not accepted.
    Positions
    next(const Positions &at, const Positions &reached)
    {
      return round++ < most_rounds ? relaxation.next(at, reached) : best;
    }

    /// Have all rounds been in vain? Then a place that is accepted should be taken as it is.
    bool
    is_at_limit() const
    {
      return round >= most_rounds;
    }

    /// Where surfaces come to follows from other forces from now on; the rounds still count.
    void
    forget_places()
    {
      relaxation = {};
      lowest     = std::numeric_limits<double>::infinity();
      best.clear();
    }

  private:
    // In cells. Steps that resolve what happens stay below the first, up to which also thin bodies
    // under large pressures get no energy worth mentioning from the difference. Beyond the second,
    // which steps of a body that shakes exceed however often they are solved again, the fluid has
    // lost or gained volume that matters.
    static constexpr double       small_misplacement   = 0.01;
    static constexpr double       largest_misplacement = 0.3;
    static constexpr unsigned int most_rounds          = 6;

    const Models<dim>        &models;
    AitkenRelaxation<dim>     relaxation;
    Positions                 best;
    double                    lowest = std::numeric_limits<double>::infinity(); ///< of `best`
    unsigned int              round  = 0;
    std::vector<Misplacement> misplacements;
  };
} // namespace undine

#endif
