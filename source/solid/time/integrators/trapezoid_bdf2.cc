// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/time/time_integrator.h>

#include <cmath>

namespace undine
{
  /// The trapezoidal rule to t^n + c h, then BDF2 (Bank, Coughran, Fichtner, Grosse, Rose, Smith,
  /// IEEE Trans. Electron Devices 32 (1985) 1992; c = 2 - sqrt(2) and the form with one factor g:
  /// Hosea, Shampine, Appl. Numer. Math. 20 (1996) 21), for bodies and fluid together:
  ///
  ///     y_1     = y^n + g (f^n + f_1),              g = c h / 2
  ///     y^{n+1} = y^n + w (f^n + f_1) + g f^{n+1},  w = sqrt(2) h / 4                        (T9)
  ///
  /// Second order, L-stable: a mode of frequency omega has the damping ratio .0037 (omega h)^3,
  /// stiff ones vanish. Pressures belong to the ends of stages, t_1 and t^{n+1}, and enter f like
  /// all other forces. In the form of Stage: f^n is kept for g, then the mean rate over the first
  /// stage for 2 (w - g), since y_1 - y^n = g (f^n + f_1).
  ///
  /// The first step, without f^n, is that of Alexander (SIAM J. Numer. Anal. 14 (1977) 1006,
  /// theorem 5): y_1 = y^n + g f_1, y^{n+1} = y^n + (h - g) f_1 + g f^{n+1}, with the same g.
  class TrapezoidBdf2 : public TimeIntegrator
  {
  public:
    void
    add_options(const Options &) override
    {
    }

    TimeAccuracy
    accuracy() const override
    {
      const double c = 2 - std::sqrt(2.);
      return {2, (3 * c * c - 4 * c + 2) / (12 * (2 - c))};
    }

    Stages
    stages(const double dt, const RatesAtBegin rates) const override
    {
      const double g     = (1 - std::sqrt(0.5)) * dt;
      const double w     = rates == RatesAtBegin::known ? g : 0;
      const auto   first = first_stage(w + g, w, KeptRate::mean);
      return in_order({first, stage_after(first, dt, g, KeptRate::at_end)});
    }

    StageCoefficients
    coefficients(const double length) const override
    {
      StageCoefficients step;
      step.mass                  = 1 / length;
      step.mass_old_velocity     = -1 / length;
      step.damping               = 1;
      step.levels                = {{1, 1}};
      step.displacement          = length;
      step.acceleration          = 1 / length;
      step.acceleration_velocity = -1 / length;
      return step;
    }
  };


  static const Register<TimeIntegrator, TrapezoidBdf2>
    trapezoid_bdf2("trapezoid_bdf2",
                   "TR-BDF2: second order for bodies and fluid, damps the highest frequencies.");
} // namespace undine
