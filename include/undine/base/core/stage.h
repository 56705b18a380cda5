// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_stage_h
#define undine_base_core_stage_h

#include <vector>

namespace undine
{
  /// The rate that a stage keeps for the stage that follows.
  enum class KeptRate
  {
    none,
    at_end, ///< f at the end of the stage
    mean    ///< (y - y^b) / (duration of the stage)
  };

  /// A part of a time step of h [s] from t^n (T10). Everything y that changes with the rate f (the
  /// displacement of bodies with their velocity, velocities with the acceleration by all forces)
  /// goes on from its value y^b at the stage's begin with the rate r that the stage before has
  /// kept, and from there takes one implicit Euler step of length g:
  ///
  ///     y^0 = y^b + w r,   y = y^0 + g f,   w + g = duration of the stage
  ///
  /// Fields that the flow advects are traced from the stage's begin to its end.
  struct Stage
  {
    double begin  = 0; ///< t^b - t^n [s]
    double end    = 0; ///< from t^n [s]
    double length = 0; ///< g [s]

    /// For how long the rate at an earlier time counts in w r.
    struct Earlier
    {
      double at     = 0; ///< from t^n [s]
      double length = 0; ///< [s]
    };
    std::vector<Earlier> earlier;

    /// What it keeps. With `none`, in steps of one stage that starts from y^n, the surface flux
    /// (B u) is that of surfaces where they are at its begin, otherwise where they are at its end.
    KeptRate kept = KeptRate::none;

    bool is_first = true;
    bool is_last  = true;

    bool
    keeps_rates() const
    {
      return kept != KeptRate::none;
    }

    /// Where the implicit Euler step begins, from t^n [s].
    double
    start() const
    {
      return end - length;
    }

    /// w: for how long everything goes on with the rate that was kept [s].
    double
    going_on() const
    {
      return start() - begin;
    }

    /// Duration of the stage: for how long the flow advects fields [s].
    double
    duration() const
    {
      return end - begin;
    }

    /// How often what contact does in the whole stage counts in its implicit step.
    double
    contact_weight() const
    {
      return keeps_rates() ? duration() / length : 1;
    }

    /// From its start to the time at which the surfaces of the surface flux are taken [s].
    double
    ahead() const
    {
      return keeps_rates() ? length : 0;
    }
  };

  using Stages = std::vector<Stage>;

  /// The same, each knowing which of them it is.
  inline Stages
  in_order(Stages stages)
  {
    for (auto &stage : stages)
      stage.is_first = stage.is_last = false;
    stages.front().is_first = true;
    stages.back().is_last   = true;
    return stages;
  }

  /// The first stage of a step, to `end`, that goes on for w = `going_on` [s] with the rate at t^n.
  inline Stage
  first_stage(const double end, const double going_on, const KeptRate kept)
  {
    Stage stage;
    stage.end     = end;
    stage.length  = end - going_on;
    stage.earlier = {{0, going_on}};
    stage.kept    = kept;
    return stage;
  }

  /// The stage after `before`, to `end`, with the mean rate that it has kept.
  inline Stage
  stage_after(const Stage &before, const double end, const double length, const KeptRate kept)
  {
    Stage stage;
    stage.begin        = before.end;
    stage.end          = end;
    stage.length       = length;
    stage.kept         = kept;
    const double share = stage.going_on() / before.duration();
    for (const auto &part : before.earlier)
      stage.earlier.push_back({part.at, share * part.length});
    stage.earlier.push_back({before.end, share * before.length});
    return stage;
  }

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
