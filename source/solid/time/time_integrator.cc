// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/time/time_integrator.h>

namespace undine
{
  double
  StageCoefficients::sum_of_weights() const
  {
    double sum = 0;
    for (const auto &level : levels)
      sum += level.weight;
    return sum;
  }


  Stages
  TimeIntegrator::stages(const double dt, const RatesAtBegin) const
  {
    return {single_stage(dt)};
  }


  bool
  TimeIntegrator::uses_acceleration() const
  {
    return false;
  }


  unsigned int
  TimeIntegrator::kind_of_rates() const
  {
    return uses_acceleration() ? 2 : stages(1., RatesAtBegin::known).size() > 1 ? 1 : 0;
  }


  double
  TimeIntegrator::acceleration_shift() const
  {
    return 0;
  }


  std::unique_ptr<TimeIntegrator>
  choose_time_integrator(const Options &scene)
  {
    return scene.section("Time").choose<TimeIntegrator>(
      "Integrator", "trapezoid_bdf2", "How bodies and fluid advance in time.");
  }
} // namespace undine
