// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_scalar_samples_h
#define undine_tests_scalar_samples_h

#include <effects/flow_run.h>

#include <limits>
#include <utility>

namespace undine_tests
{
  /// Smoke that fluxes transport.
  inline std::string
  smoke_by_fluxes(const std::string &keys)
  {
    return section("scalar transport", "set Form = flux\n" + section("smoke", keys));
  }


  /// The least and the largest value of all ranks, in fluid.
  template <int dim>
  std::pair<double, double>
  range_of(const Field<dim> &values)
  {
    double least = std::numeric_limits<double>::max(), most = -least;
    for_each_value(values, [&](const double value, const auto &, const auto &) {
      least = std::min(least, value);
      most  = std::max(most, value);
    });
    return {dealii::Utilities::MPI::min(least, MPI_COMM_WORLD),
            dealii::Utilities::MPI::max(most, MPI_COMM_WORLD)};
  }
} // namespace undine_tests

#endif
