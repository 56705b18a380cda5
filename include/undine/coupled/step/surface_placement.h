// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_surface_placement_h
#define undine_coupled_step_surface_placement_h

#include <undine/base/core/errors.h>
#include <undine/coupled/immersed/anderson_acceleration.h>
#include <undine/coupled/step/misplacement.h>

#include <algorithm>
#include <cmath>
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
      if (by.cells <= (is_last ? largest_misplacement : enough()))
        return true;
      if (by.cells < lowest)
        {
          lowest = by.cells;
          best   = at;
        }
      if (is_last || (round >= hopeless_rounds && lowest > largest_misplacement))
        throw SolveError(misplacement_complaint(models, reached, misplacements));
      return false;
    }

    /// Where to cut the grid next [m], after a place that was not accepted.
    Positions
    next(const Positions &at, const Positions &reached)
    {
      ++round;
      is_last = lowest <= enough();
      solved  = at;
      tried   = is_last ? best : acceleration.next(at, reached);
      return tried;
    }

    /// Can another place be tried after one at which the stage has no solution?
    bool
    can_retreat() const
    {
      return !solved.empty() && !is_at_limit();
    }

    /// Where to cut the grid then [m]: half-way back to the last place at which there was one.
    Positions
    retreat()
    {
      ++round;
      for (std::size_t node = 0; node < tried.size(); ++node)
        tried[node] += (solved[node] - tried[node]) / 2;
      return tried;
    }

    /// Is this the last round? Then a place that is accepted should be taken as it is.
    bool
    is_at_limit() const
    {
      return is_last || round >= most_rounds;
    }

    /// Where surfaces come to follows from other forces from now on; the rounds still count.
    void
    forget_places()
    {
      acceleration = {};
      lowest       = std::numeric_limits<double>::infinity();
      best.clear();
      solved.clear();
    }

  private:
    /// What misplacement is accepted in this round [1]: in later ones it grows geometrically.
    double
    enough() const
    {
      const double late =
        std::max(0., double(round) - strict_rounds) / (most_rounds - strict_rounds);
      return small_misplacement * std::pow(largest_misplacement / small_misplacement, late);
    }

    // In cells. Steps that resolve what happens stay below the first, up to which also thin bodies
    // under large pressures get no energy worth mentioning from the difference. Beyond the second,
    // which steps of a body that shakes exceed however often they are solved again, the fluid has
    // lost or gained volume that matters. Between them a place found early is worth more than a
    // closer one: pressures jump as surfaces cross planes of the grid, and a light body follows
    // them.
    static constexpr double       small_misplacement   = 0.01;
    static constexpr double       largest_misplacement = 0.2;
    static constexpr unsigned int strict_rounds        = 3;
    static constexpr unsigned int hopeless_rounds      = 6; ///< if none is as close as the second
    static constexpr unsigned int most_rounds          = 12;

    const Models<dim>        &models;
    AndersonAcceleration<dim> acceleration;
    Positions                 best;
    Positions                 solved, tried; ///< the last place with a solution, and the next one
    double                    lowest  = std::numeric_limits<double>::infinity(); ///< of `best`
    unsigned int              round   = 0;
    bool                      is_last = false; ///< the best place is tried again
    std::vector<Misplacement> misplacements;
  };
} // namespace undine

#endif
