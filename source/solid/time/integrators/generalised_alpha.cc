// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/time/time_integrator.h>

namespace undine
{
  /// The generalised-alpha method [Chung, Hulbert, J. Appl. Mech. 60 (1993) 371, equations 12-17,
  /// 25] for accelerations a that inertia minus internal forces and loads give, with r the spectral
  /// radius at infinite frequency, alpha_m = (2r-1)/(r+1), alpha_f = r/(r+1),
  /// gamma = 1/2 - alpha_m + alpha_f, beta = (1 - alpha_m + alpha_f)^2 / 4:
  ///
  ///     M [(1-alpha_m) a^{n+1} + alpha_m a^n] + C u_f + K(d_f) - f(t_f) = 0,         (T4)
  ///         x_f = (1-alpha_f) x^{n+1} + alpha_f x^n  for d, u and t
  ///     u^{n+1} = u^n + h [(1-gamma) a^n + gamma a^{n+1}] + M^{-1} h J p
  ///     d^{n+1} = d^n + h u^n + h^2 (1/2-beta) a^n
  ///             + h (beta/gamma) (u^{n+1} - u^n - h (1-gamma) a^n)
  ///
  /// The impulse h J p of a fluid's pressure is added once and is no part of a. Eliminating a^{n+1}
  /// and scaling by gamma / (1-alpha_m) gives the form of StageCoefficients. Second order.
  class GeneralisedAlpha : public TimeIntegrator
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.add("Spectral radius",
                  radius,
                  "1",
                  Allowed::between(0, 1),
                  "At infinite frequency; 1: no damping, 0: the highest modes vanish in one step.");
    }

    StageCoefficients
    coefficients(const double dt) const override
    {
      const double      alpha_m = this->alpha_m();
      const double      alpha_f = radius / (radius + 1);
      const double      gamma   = this->gamma();
      const double      beta    = (1 - alpha_m + alpha_f) * (1 - alpha_m + alpha_f) / 4;
      const double      scale   = gamma / (1 - alpha_m);
      StageCoefficients step;
      step.mass                      = 1 / dt;
      step.mass_old_velocity         = -1 / dt;
      step.mass_old_acceleration     = scale * alpha_m - (1 - gamma);
      step.damping                   = scale * (1 - alpha_f);
      step.damping_old_velocity      = scale * alpha_f;
      step.levels                    = {{scale, 1 - alpha_f}};
      step.displacement              = dt * beta / gamma;
      step.displacement_velocity     = dt * (1 - beta / gamma);
      step.displacement_acceleration = dt * dt * (0.5 - beta / gamma);
      step.acceleration              = 1 / (gamma * dt);
      step.acceleration_velocity     = -1 / (gamma * dt);
      step.acceleration_acceleration = -(1 - gamma) / gamma;
      return step;
    }

    TimeAccuracy
    accuracy() const override
    {
      const double sum = radius + 1;
      return {2, (11 * radius * radius - 14 * radius + 11) / (24 * sum * sum)};
    }

    bool
    uses_acceleration() const override
    {
      return true;
    }

    double
    acceleration_shift() const override
    {
      // gamma a^{n+1} + (1-gamma) a^n is the acceleration at t^n + h/2.
      return 0.5 - gamma();
    }

  private:
    double
    alpha_m() const
    {
      return (2 * radius - 1) / (radius + 1);
    }

    double
    gamma() const
    {
      return 0.5 - alpha_m() + radius / (radius + 1);
    }

    double radius = 0.8;
  };


  static const Register<TimeIntegrator, GeneralisedAlpha>
    generalised_alpha("generalised_alpha",
                      "Second order with damping of the highest frequencies only.");
} // namespace undine
