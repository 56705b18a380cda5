// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_time_weighted_integrator_h
#define undine_solid_time_weighted_integrator_h

#include <undine/solid/time/time_integrator.h>

#include <string>
#include <utility>

namespace undine
{
  /// A method with one number, the weight w of the end of a step against its begin: from 1/2, where
  /// it is of second order and damps nothing, to 1. Inertia enters it as M (u^{n+1} - u^n) / h. A
  /// derived class says where internal forces and drag are taken and what displacement follows from
  /// the velocities.
  class WeightedIntegrator : public TimeIntegrator
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.add(key, weight, "1", Allowed::between(0.5, 1), help);
    }

    /// Those of inertia and acceleration; the others are zero.
    StageCoefficients
    coefficients(const double dt) const override
    {
      StageCoefficients step;
      step.mass                  = 1 / dt;
      step.mass_old_velocity     = -1 / dt;
      step.acceleration          = 1 / dt;
      step.acceleration_velocity = -1 / dt;
      return step;
    }

  protected:
    /// `key` and `help` describe w, `initial_weight` is its default.
    WeightedIntegrator(std::string key, std::string help, const double initial_weight)
      : weight(initial_weight)
      , key(std::move(key))
      , help(std::move(help))
    {
    }

    /// First order with the constant `factor` (w - 1/2); at w = 1/2 as accurate as the trapezoid.
    TimeAccuracy
    accuracy_of_weight(const double factor) const
    {
      return weight > 0.5 ? TimeAccuracy{1, factor * (weight - 0.5)} : TimeAccuracy{2, 1. / 12};
    }

    double weight; ///< w [1]

  private:
    std::string key;
    std::string help;
  };
} // namespace undine

#endif
