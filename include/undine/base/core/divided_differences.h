// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_divided_differences_h
#define undine_base_core_divided_differences_h

#include <cstddef>
#include <vector>

namespace undine
{
  /// Numbers w_i, one for each of k + 1 distinct times t_i [s], with which sum_i w_i f(t_i) is the
  /// k-th derivative of f somewhere between them, exactly that of a polynomial of degree k: k!
  /// times the weights of Newton's divided difference [1/s^k].
  inline std::vector<double>
  derivative_weights(const std::vector<double> &times)
  {
    std::vector<double> weights(times.size(), 1.);
    for (std::size_t i = 0; i < times.size(); ++i)
      for (std::size_t j = 0, factor = 1; j < times.size(); ++j)
        if (j != i)
          weights[i] *= factor++ / (times[i] - times[j]);
    return weights;
  }
} // namespace undine

#endif
