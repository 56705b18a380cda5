// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/time_integrator.h>

namespace undine
{
  double
  StepCoefficients::sum_of_weights() const
  {
    double sum = 0;
    for (const auto &stage : stages)
      sum += stage.weight;
    return sum;
  }


  bool
  TimeIntegrator::uses_acceleration() const
  {
    return false;
  }


  double
  TimeIntegrator::acceleration_shift() const
  {
    return 0;
  }
} // namespace undine
