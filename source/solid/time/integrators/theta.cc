// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/time/weighted_integrator.h>

namespace undine
{
  /// The theta method, all forces at t^n + theta h:
  ///
  ///     M (u^{n+1} - u^n) / h + C u_theta + K(d_theta) - f(t^n + theta h) = J p  (T2)
  ///     u_theta = (1-theta) u^n + theta u^{n+1}
  ///     d_theta = d^n + theta h u_theta,  d^{n+1} = d^n + h u_theta
  ///
  /// theta = 1/2 is the midpoint rule, second order; theta = 1 backward Euler. A mode of frequency
  /// omega is damped by about (theta - 1/2) omega^2 h per second.
  class Theta : public WeightedIntegrator
  {
  public:
    Theta()
      : WeightedIntegrator(
          "Theta", "1/2: midpoint, second order, no damping of its own; 1: backward Euler.", 0.6)
    {
    }

    StageCoefficients
    coefficients(const double dt) const override
    {
      auto step                  = WeightedIntegrator::coefficients(dt);
      step.damping               = weight;
      step.damping_old_velocity  = 1 - weight;
      step.levels                = {{1, weight}};
      step.displacement          = weight * dt;
      step.displacement_velocity = (1 - weight) * dt;
      return step;
    }

    TimeAccuracy
    accuracy() const override
    {
      return accuracy_of_weight(1);
    }
  };


  static const Register<TimeIntegrator, Theta>
    theta("theta", "All forces at t + theta h; 1/2 is the midpoint rule, 1 backward Euler.");
} // namespace undine
