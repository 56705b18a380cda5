// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_stage_h
#define undine_base_core_stage_h

#include <vector>

namespace undine
{
  /// A part of a time step of h [s] from t^n (T9). Everything y that changes with the rate f (the
  /// displacement of bodies with their velocity, velocities with the acceleration by all forces)
  /// starts from y^0 and takes one implicit Euler step of length g:
  ///
  ///     y = y^0 + g f,   f = (y - y^0) / g,
  ///
  /// where y^0 = y^n + w f^n in the first stage, and y^n + w' f^n + w'' f_1 in the second. Fields
  /// that the flow carries are traced from the stage's begin to its end.
  struct Stage
  {
    double begin  = 0; ///< from t^n [s]
    double end    = 0; ///< from t^n [s]
    double length = 0; ///< g [s]

    /// For how long the rate of an earlier time counts.
    struct Earlier
    {
      double at     = 0; ///< from t^n [s]
      double length = 0; ///< w, w' or w'' [s]
    };

    std::vector<Earlier> earlier;  ///< of which y^0 is made, t^n first
    Earlier              next_old; ///< the share of t^n in the stage that follows
    Earlier              next_new; ///< the share of this stage in it

    bool is_first = true;
    bool is_last  = true;

    /// False: a step of one stage that starts from y^n, with the surface flux (B u) of surfaces
    /// where they are at its begin. True: rates are kept from step to step, and the surface flux is
    /// that of surfaces where they are at the end of the stage.
    bool keeps_rates = false;

    /// Where the implicit Euler step begins, from t^n [s].
    double
    start() const
    {
      return end - length;
    }

    /// The share of t^n in y^0 [s].
    double
    rate() const
    {
      return earlier.empty() ? 0 : earlier.front().length;
    }

    /// Duration of the stage: for how long the flow carries fields [s].
    double
    duration() const
    {
      return end - begin;
    }

    /// From its start to the time at which the surfaces of the surface flux are taken [s].
    double
    ahead() const
    {
      return keeps_rates ? length : 0;
    }
  };

  using Stages = std::vector<Stage>;

  /// The whole step of `dt` [s].
  inline Stage
  single_stage(const double dt)
  {
    Stage stage;
    stage.end    = dt;
    stage.length = dt;
    return stage;
  }
} // namespace undine

#endif
