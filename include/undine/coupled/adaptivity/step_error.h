// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_adaptivity_step_error_h
#define undine_coupled_adaptivity_step_error_h

#include <undine/coupled/adaptivity/sample_norms.h>
#include <undine/coupled/state/report.h>

namespace undine
{
  /// Chooses steps by their error in time, from what all methods of an order have in common: that
  /// of a step of h is C h^(p+1) |y^(p+1)|. Derivatives are divided differences of the velocities
  /// of accepted steps. y is the bodies' displacement, or the velocity of a fluid without bodies.
  ///
  /// Errors of all steps are to add up, over the run of length T, to the tolerance times the
  /// largest size of y so far, D:
  ///
  ///     C h^p |y^(p+1)| = tolerance (D / T + dD/dt / 4)                                      (T7)
  ///
  /// |y^(p+1)| is (|y^(p+1)|^2 + |y^(p)| |y^(p+2)|)^(1/2), which does not vanish twice a period.
  /// Differences are taken over times H apart,
  ///
  ///     H^(p+1) = 4 C h^p T                                                                  (T8)
  ///
  /// at which a vibration that is too fast to be followed over the run counts with its amplitude:
  /// its error of phase costs no more than that. The step is the geometric mean of the two last
  /// solutions of (T7), the filter H211b with b = 2 [Soderlind, ACM Trans. Math. Softw. 29 (2003)
  /// 1]; it is at most doubled by a step. A step with C h^(p+1) |y^(p+1)|, by the newest steps
  /// alone, above a quarter of tolerance D is too long, as after a sudden load.
  template <int dim>
  class StepError
  {
  public:
    /// What limits the choice of steps.
    struct Settings
    {
      double tolerance     = 0; ///< [1]
      double displacement  = 0; ///< D is at least this [m]; 0: a share of the bodies' extent
      double longest_step  = 0; ///< [s]
      double shortest_step = 0; ///< [s]
      double first_step    = 0; ///< [s]
    };

    /// `models` must outlive it. Collective.
    StepError(const Models<dim>    &models,
              const TimeIntegrator &integrator,
              const Settings       &settings);

    /// Start the history of a state at its first time. Collective.
    void
    start(State<dim> &state) const;

    /// True if a step of `dt` [s] from `old_state` to `state` has too large an error on its own.
    /// Collective.
    bool
    is_too_large(const State<dim> &old_state, const State<dim> &state, double dt) const;

    /// Take an accepted step from `old_state` into the history of `state`, and choose the next; it
    /// is no longer than this one if this one, as the `report` on it says, was cut. Collective.
    void
    accept(State<dim> &state, const State<dim> &old_state, const Report &report) const;

    /// The sum of the errors of all steps so far over D [1].
    double
    error(const StepHistory<dim> &history) const;

    /// True if the tolerance is used up, and would take steps that are shorter than the shortest.
    bool
    is_missed(const StepHistory<dim> &history) const;

  private:
    using History = StepHistory<dim>;

    double
    size(const State<dim> &state) const;
    void
    take_sample(State<dim> &state, double time) const;
    double
    derivative(const History &history, unsigned int order) const;
    void
    estimate(History &history, double allowed) const;
    double
    interval(const History &history, double dt, double run) const;
    double
    scale(const History &history) const;
    double
    allowed_rate(const State<dim> &state, double time) const;

    const Models<dim>     &models;
    const SampleNorms<dim> norms;
    const Settings         settings;
    const TimeAccuracy     accuracy;
    const double           least_size; ///< of y
  };
} // namespace undine

#endif
