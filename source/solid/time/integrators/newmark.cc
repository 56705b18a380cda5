// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/time/time_integrator.h>

namespace undine
{
  /// Newmark's method in impulse form with beta = gamma / 2:
  ///
  ///     M (u^{n+1} - u^n) / h + C ((1-g) u^n + g u^{n+1})
  ///       + (1-g) [K(d^n) - f^n] + g [K(d^{n+1}) - f^{n+1}] = J p                         (T3)
  ///     d^{n+1} = d^n + h (u^n + u^{n+1}) / 2
  ///
  /// gamma = 1/2 is the trapezoid, second order; gamma = 1 with one Newton iteration is the scheme
  /// of Chentanez, Goktekin, Feldman, O'Brien, Simultaneous Coupling of Fluids and Deformable
  /// Bodies, equation 2. K' in C is taken at d^n + (1-g) h u^n: at gamma = 1 that is d^n.
  class Newmark : public TimeIntegrator
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.add("Gamma",
                  gamma,
                  "1",
                  Allowed::between(0.5, 1),
                  "1/2: trapezoid, second order, no damping of its own; 1: strongly damped.");
    }

    StepCoefficients
    coefficients(const double dt) const override
    {
      StepCoefficients step;
      step.mass                 = 1 / dt;
      step.mass_old_velocity    = -1 / dt;
      step.damping              = gamma;
      step.damping_old_velocity = 1 - gamma;
      step.damping_position     = 1 - gamma;
      step.stages               = {{gamma, 1}};
      if (gamma < 1)
        step.stages.push_back({1 - gamma, 0});
      step.displacement          = dt / 2;
      step.displacement_velocity = dt / 2;
      step.acceleration          = 1 / dt;
      step.acceleration_velocity = -1 / dt;
      return step;
    }

    TimeAccuracy
    accuracy() const override
    {
      // The displacement is that of the trapezoid: only the velocity is of first order.
      return gamma > 0.5 ? TimeAccuracy{1, (gamma - 0.5) / 2} : TimeAccuracy{2, 1. / 12};
    }

  private:
    double gamma = 0.5;
  };


  static const Register<TimeIntegrator, Newmark>
    newmark("newmark", "Impulse form with beta = gamma / 2; gamma = 1/2 is the trapezoid.");
} // namespace undine
