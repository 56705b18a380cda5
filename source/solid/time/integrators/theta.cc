// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/time/time_integrator.h>

namespace undine
{
  /// The theta method, all forces at t^n + theta h:
  ///
  ///     M (u^{n+1} - u^n) / h + C u_theta + K(d_theta) - f(t^n + theta h) = J p           (T2)
  ///     u_theta = (1-theta) u^n + theta u^{n+1}
  ///     d_theta = d^n + theta h u_theta,  d^{n+1} = d^n + h u_theta
  ///
  /// theta = 1/2 is the midpoint rule, second order; theta = 1 backward Euler. A mode of frequency
  /// omega is damped by about (theta - 1/2) omega^2 h per second. K' in C is taken at
  /// d^n + (1-theta) h u^n, without which theta = 1/2 would be first order with damping.
  class Theta : public TimeIntegrator
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.add("Theta",
                  theta,
                  "1",
                  Allowed::between(0.5, 1),
                  "1/2: midpoint, second order, no damping of its own; 1: backward Euler.");
    }

    StepCoefficients
    coefficients(const double dt) const override
    {
      StepCoefficients step;
      step.mass                  = 1 / dt;
      step.mass_old_velocity     = -1 / dt;
      step.damping               = theta;
      step.damping_old_velocity  = 1 - theta;
      step.damping_position      = 1 - theta;
      step.stages                = {{1, theta}};
      step.displacement          = theta * dt;
      step.displacement_velocity = (1 - theta) * dt;
      step.acceleration          = 1 / dt;
      step.acceleration_velocity = -1 / dt;
      return step;
    }

    TimeAccuracy
    accuracy() const override
    {
      return theta > 0.5 ? TimeAccuracy{1, theta - 0.5} : TimeAccuracy{2, 1. / 12};
    }

  private:
    double theta = 0.6;
  };


  static const Register<TimeIntegrator, Theta>
    theta("theta", "All forces at t + theta h; 1/2 is the midpoint rule, 1 backward Euler.");
} // namespace undine
