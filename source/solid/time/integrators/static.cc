// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/time/time_integrator.h>

namespace undine
{
  /// Equilibrium at the end of every step, without inertia and damping:
  ///
  ///     K(d^{n+1}) = f(t^{n+1}) + J p,   u^{n+1} = (d^{n+1} - d^n) / h                    (T5)
  class Static : public TimeIntegrator
  {
  public:
    void
    add_options(const Options &) override
    {
    }

    StageCoefficients
    coefficients(const double dt) const override
    {
      StageCoefficients step;
      step.levels       = {{1, 1}};
      step.displacement = dt;
      return step;
    }

    TimeAccuracy
    accuracy() const override
    {
      return {1, 0}; // equilibrium is exact at every time
    }
  };


  static const Register<TimeIntegrator, Static>
    equilibrium("static", "Equilibrium at the end of every step, without inertia and damping.");
} // namespace undine
