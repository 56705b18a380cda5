// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/time/weighted_integrator.h>

namespace undine
{
  /// Newmark's method in impulse form with beta = gamma / 2 and the weight g = gamma:
  ///
  ///     M (u^{n+1} - u^n) / h + C u_m
  ///       + (1-g) [K(d^n) - f^n] + g [K(d^{n+1}) - f^{n+1}] = J p                         (T3)
  ///     u_m = (u^n + u^{n+1}) / 2,  d_m = (d^n + d^{n+1}) / 2,  d^{n+1} = d^n + h u_m
  ///
  /// gamma = 1/2 is the trapezoid, second order; gamma = 1 with one Newton iteration is the scheme
  /// of Chentanez, Goktekin, Feldman, O'Brien, Simultaneous Coupling of Fluids and Deformable
  /// Bodies, equation 2, but for damping, which they take at the end of a step. Damping of the mean
  /// velocity takes energy for every gamma.
  class Newmark : public WeightedIntegrator
  {
  public:
    Newmark()
      : WeightedIntegrator(
          "Gamma", "1/2: trapezoid, second order, no damping of its own; 1: strongly damped.", 0.5)
    {
    }

    StageCoefficients
    coefficients(const double dt) const override
    {
      auto step   = WeightedIntegrator::coefficients(dt);
      step.levels = {{weight, 1}};
      if (weight < 1)
        step.levels.push_back({1 - weight, 0});
      step.damping = step.damping_old_velocity = 0.5;
      step.displacement                        = dt / 2;
      step.displacement_velocity               = dt / 2;
      return step;
    }

    TimeAccuracy
    accuracy() const override
    {
      // The displacement is that of the trapezoid: only the velocity is of first order.
      return accuracy_of_weight(0.5);
    }
  };


  static const Register<TimeIntegrator, Newmark>
    newmark("newmark", "Impulse form with beta = gamma / 2; gamma = 1/2 is the trapezoid.");
} // namespace undine
